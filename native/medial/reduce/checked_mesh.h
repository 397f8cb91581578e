// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the input of callers, and prepares it for the computation.
#pragma once

#include <medial/sphere_mesh.h>

#include "base/frame.h"

namespace medial {

// Throws InvalidInputError for rows out of range, numbers that are not finite, and negative radii.
void require_sphere_mesh(const SphereMesh& mesh);

// Returns the mesh with each triangle once, in their order, and the wires that are on none of them,
// i < j, ascending, each once. Edges from a vertex to itself, and triangles without three distinct
// corners, are omitted.
SphereMesh without_doubles(SphereMesh mesh);

// Returns the sides of triangles, lower end first, as often as triangles have them.
std::vector<Edge> sides_of(std::span<const Triangle> triangles);

// Returns a frame about the middle of a mesh, in a unit that is a power of two near its extent.
Frame frame_of(const SphereMesh& mesh);

}  // namespace medial
