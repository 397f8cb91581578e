// SPDX-License-Identifier: GPL-3.0-or-later
// TIGHTCOCONE(P): the watertight surface through samples, and what is to be said of it (Dey &
// Goswami 2003).
#pragma once

#include <medial/options.h>
#include <medial/progress.h>

#include <span>

namespace medial {

// The surface, the side of every cell, and how well the samples lie.
struct WatertightSurface {
  std::vector<Triangle> triangles;              // outward, lowest row first, in lexicographic order
  std::vector<Side> sides;                      // per Delaunay cell: inner or outer
  std::vector<int32_t> samples;                 // rows of the distinct points, ascending
  std::vector<uint8_t> flat, good, on_surface;  // per sample, in the order of `samples`
  int64_t nonmanifold_edges = 0, nonmanifold_vertices = 0, cavities = 0, inner_cells = 0,
          left_outside = 0;
  int64_t duplicates = 0;
  Timings timings;

  // Otherwise the solid is empty, or pinched to pieces, and says nothing about the shape.
  bool encloses() const { return 2 * left_outside <= static_cast<int64_t>(samples.size()); }
};

// `threads` 0: all cores; the result does not depend on it. Throws InvalidInputError,
// DegenerateInputError, Cancelled.
WatertightSurface watertight_surface(std::span<const Vec3> points,
                                     const CoconeOptions& options = {}, int threads = 0,
                                     Progress* progress = nullptr);

}  // namespace medial
