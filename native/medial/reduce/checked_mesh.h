// SPDX-License-Identifier: GPL-3.0-or-later
// The input of callers, checked and prepared for the computation.
#pragma once

#include <medial/sphere_mesh.h>

namespace medial {

// Throws InvalidInputError for rows out of range, numbers that are not finite, negative radii.
void require_sphere_mesh(const SphereMesh& mesh);

// Triangles each once, in their order; wires that are on none of them, i < j, ascending, each once.
// Edges from a vertex to itself, and triangles without three corners, are left out.
SphereMesh without_doubles(SphereMesh mesh);

// Where coordinates are multiples of a power of two near the extent, round the middle.
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
