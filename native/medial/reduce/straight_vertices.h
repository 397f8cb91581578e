// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves out vertices in the middle of straight edges.
#pragma once

#include <medial/sphere_mesh.h>

#include <vector>

#include "reduce/flat_faces.h"

namespace medial {

// Leaves out, from the polygons and from the mesh, vertices that have two neighbours in all
// polygons and lie between them on a line along which radii change linearly. Polygons keep three
// corners. `row` has a value per vertex. The mesh must be in a unit near its extent.
void leave_out_straight_vertices(SphereMesh& mesh, std::vector<FlatFace>& faces,
                                 std::vector<int32_t>& row);

}  // namespace medial
