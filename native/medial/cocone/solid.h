// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of the inner cells: a subcomplex of the Delaunay triangulation.
#pragma once

#include "delaunay/face_set.h"
#include "inside/sides.h"

namespace medial {

struct SolidBoundary {
  std::vector<Triangle> triangles;   // outward
  std::vector<uint8_t> on_surface;   // per sample: a corner of a triangle
  int64_t nonmanifold_edges = 0;     // in more than two triangles
  int64_t nonmanifold_vertices = 0;  // the triangles round it are not one disc
  int64_t inner_cells = 0;
  int64_t left_outside = 0;  // samples without an inner cell
};

// Its triangles alone.
std::vector<Triangle> boundary_triangles(const Triangulation& triangulation, const CellSides& sides,
                                         const Run& run);

// Every edge is in an even number of triangles.
SolidBoundary solid_boundary(const Triangulation& triangulation, const Csr<int32_t>& incident,
                             const CellSides& sides, const Run& run);

}  // namespace medial
