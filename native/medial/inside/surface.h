// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles of the sampled surface, as ids of its distinct vertices.
#pragma once

#include "inside/boundary.h"

namespace medial {

struct Surface {
  std::vector<Triangle> triangles;  // outward; triangles with a repeated corner are left out
  std::vector<Edge> boundary;       // as from boundary_edges

  // Edges in the boundary, whatever their surplus.
  int64_t open_edges() const;
  // Then the winding number is an integer everywhere off the surface.
  bool closed() const { return !triangles.empty() && boundary.empty(); }
};

// Throws InvalidInputError for a corner outside [0, rows).
void require_corners(std::span<const Triangle> triangles, size_t rows);

// `triangles` holds rows, `vertex_of_row` the first `vertices` ids. Rows with the same coordinates
// are one vertex, so seams close.
Surface make_surface(std::span<const Triangle> triangles, std::span<const int32_t> vertex_of_row,
                     int32_t vertices, const Run& run);

// Surface::open_edges of triangles that hold rows.
int64_t open_edges(std::span<const Vec3> rows, std::span<const Triangle> triangles, const Run& run);

}  // namespace medial
