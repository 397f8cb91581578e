// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of the inner cells is a subcomplex of the Delaunay triangulation.
#pragma once

#include "delaunay/face_set.h"
#include "inside/sides.h"

namespace medial {

struct SolidBoundary {
  std::vector<Triangle> triangles;   // oriented outward
  std::vector<uint8_t> on_surface;   // per sample: 1 if it is a corner of a triangle
  int64_t nonmanifold_edges = 0;     // edges in more than two triangles
  int64_t nonmanifold_vertices = 0;  // vertices whose triangles are not one disc
  int64_t inner_cells = 0;
  int64_t left_outside = 0;  // samples without an inner cell
};

// Returns the triangles of the boundary alone.
std::vector<Triangle> boundary_triangles(const Triangulation& triangulation, const CellSides& sides,
                                         const Run& run);

// Returns the boundary; every edge of it is in an even number of triangles.
SolidBoundary solid_boundary(const Triangulation& triangulation, const Csr<int32_t>& incident,
                             const CellSides& sides, const Run& run);

}  // namespace medial
