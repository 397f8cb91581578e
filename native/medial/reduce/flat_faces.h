// SPDX-License-Identifier: GPL-3.0-or-later
// Joins triangles of a sheet that lie in one plane to polygons with few corners.
#pragma once

#include <medial/sphere_mesh.h>

#include <vector>

namespace medial {

struct FlatFace {
  int32_t part = -1;
  std::vector<int32_t> corners;
};

// Returns the polygons, and the triangles that are not flat together with a neighbour, in the order
// of their parts. Every edge and vertex of the mesh that is not between two triangles of one
// polygon stays; the boundary of a polygon is one loop that touches no vertex twice. Radii change
// linearly over a polygon, so any triangles of it have the same slabs. The mesh must be in a unit
// near its extent, with one part per triangle.
std::vector<FlatFace> flat_faces(const SphereMesh& mesh, const std::vector<int32_t>& part);

// Leaves out, from the polygons and from the mesh, vertices that have two neighbours in all
// polygons and lie between them on a line along which radii change linearly. Polygons keep three
// corners. `row` has a value per vertex. The mesh must be in a unit near its extent.
void leave_out_straight_vertices(SphereMesh& mesh, std::vector<FlatFace>& faces,
                                 std::vector<int32_t>& row);

}  // namespace medial
