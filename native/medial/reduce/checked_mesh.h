// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the input of callers, and prepares it for the computation.
#pragma once

#include <medial/sphere_mesh.h>

namespace medial {

// Throws InvalidInputError for rows out of range, numbers that are not finite, and negative radii.
void require_sphere_mesh(const SphereMesh& mesh);

// Returns the mesh with each triangle once, in their order, and the wires that are on none of them,
// i < j, ascending, each once. Edges from a vertex to itself, and triangles without three distinct
// corners, are omitted.
SphereMesh without_doubles(SphereMesh mesh);

// Defines coordinates about the middle of a mesh, in a unit that is a power of two near its extent.
struct Unit {
  Vec3 origin;
  int exponent = 0;

  Vec3 inward(const Vec3& p) const;
  double inward(double length) const;
  Vec3 outward(const Vec3& p) const;
  double outward(double length) const;
};
Unit unit_of(const SphereMesh& mesh);

}  // namespace medial
