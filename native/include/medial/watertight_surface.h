// SPDX-License-Identifier: GPL-3.0-or-later
// TIGHTCOCONE(P) makes the watertight surface through samples, and reports on its quality (Dey &
// Goswami 2003).
#pragma once

#include <medial/options.h>
#include <medial/progress.h>

#include <span>

namespace medial {

// This holds the surface, the side of every cell, and how well the samples lie.
struct WatertightSurface {
  std::vector<Triangle> triangles;              // outward, lowest row first, in lexicographic order
  std::vector<Side> sides;                      // per Delaunay cell: inner or outer
  std::vector<int32_t> samples;                 // rows of the distinct points, ascending
  std::vector<uint8_t> flat, good, on_surface;  // per sample, in the order of `samples`
  int64_t nonmanifold_edges = 0, nonmanifold_vertices = 0, cavities = 0, inner_cells = 0,
          left_outside = 0;
  int64_t duplicates = 0;
  Timings timings;

  // If false, the solid is empty or in pieces, and does not describe the shape.
  bool encloses() const { return 2 * left_outside <= static_cast<int64_t>(samples.size()); }
};

// Computes the surface. `threads` 0 means all cores; the result does not depend on it. Throws
// InvalidInputError, DegenerateInputError, Cancelled.
WatertightSurface watertight_surface(std::span<const Vec3> points,
                                     const CoconeOptions& options = {}, int threads = 0,
                                     Progress* progress = nullptr);

}  // namespace medial
