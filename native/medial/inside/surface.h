// SPDX-License-Identifier: GPL-3.0-or-later
// The surface holds the triangles of the sampled surface, as ids of its distinct vertices.
#pragma once

#include "inside/boundary.h"

namespace medial {

struct Surface {
  std::vector<Triangle> triangles;  // outward; triangles with a repeated corner are omitted
  std::vector<Edge> boundary;       // the result of boundary_edges

  // Returns the number of edges in the boundary, whatever their surplus.
  int64_t open_edges() const;
  // Returns whether the surface is closed: the winding number is an integer everywhere off it.
  bool closed() const { return !triangles.empty() && boundary.empty(); }
};

// Throws InvalidInputError for a corner outside [0, rows).
void require_corners(std::span<const Triangle> triangles, size_t rows);

// Makes the surface; `triangles` holds rows, and `vertex_of_row` the ids of the first `vertices`
// vertices. Rows with the same coordinates are one vertex, so seams close.
Surface make_surface(std::span<const Triangle> triangles, std::span<const int32_t> vertex_of_row,
                     int32_t vertices, const Run& run);

// Returns Surface::open_edges of triangles of rows.
int64_t open_edges(std::span<const Vec3> rows, std::span<const Triangle> triangles, const Run& run);

}  // namespace medial
