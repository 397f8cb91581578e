// TIGHTCOCONE(P): the watertight surface through input rows, and what is to be said of it.
#pragma once

#include "base/stopwatch.h"
#include "cocone/peeling.h"
#include "cocone/solid.h"
#include "delaunay/samples.h"

namespace medial {

struct WatertightSurface {
  std::vector<Triangle> triangles;              // outward, lowest row first, in lexicographic order
  CellSides sides;                              // per Delaunay cell
  std::vector<int32_t> samples;                 // rows of the distinct points, ascending
  std::vector<uint8_t> flat, good, on_surface;  // per sample, in the order of `samples`
  int64_t nonmanifold_edges = 0, nonmanifold_vertices = 0, cavities = 0, inner_cells = 0,
          left_outside = 0;
  int64_t duplicates = 0;
  Timings timings;

  // Otherwise the solid is empty, or pinched to pieces, and says nothing about the shape.
  bool encloses() const { return 2 * left_outside <= static_cast<int64_t>(samples.size()); }
};

// Triangles of samples as triangles of rows: lowest row first, in lexicographic order.
std::vector<Triangle> in_rows(std::vector<Triangle> triangles, const Samples& samples,
                              const Run& run);

// In terms of the rows.
WatertightSurface describe(TightCocone result, SolidBoundary boundary, const Samples& samples,
                           const Run& run);

// Throws InvalidInputError, DegenerateInputError, Cancelled.
WatertightSurface watertight_surface(std::span<const Vec3> rows, const CoconeOptions& options,
                                     const Run& run);

}  // namespace medial
