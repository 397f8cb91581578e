// The boundary of the inner cells: a subcomplex of the Delaunay triangulation.
#pragma once

#include "facet_set.h"
#include "sides.h"

namespace medial {

struct SolidBoundary {
  std::vector<Triangle> triangles;   // outward
  std::vector<uint8_t> on_surface;   // per sample: a corner of a triangle
  int64_t nonmanifold_edges = 0;     // in more than two triangles
  int64_t nonmanifold_vertices = 0;  // the triangles round it are not one disc
  int64_t inner_cells = 0;
};

// Outward unit normals of the boundary at the samples, its triangles weighted by area; zero off the
// boundary.
std::vector<Vec3> boundary_normals(std::span<const Vec3> points, const SolidBoundary& boundary);

// Every edge is in an even number of triangles.
SolidBoundary solid_boundary(const Triangulation& triangulation, const Csr<int32_t>& incident,
                             const CellSides& sides, const Run& run);

}  // namespace medial
