// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the normal of a smooth surface at a vertex from the vertices round it, however uneven the
// triangles are.
#pragma once

#include <span>

#include "base/vec3.h"

namespace medial {

// The normals that the triangles round a vertex give, both of length 1.
struct TriangleNormals {
  Vec3 by_angle;  // their mean, weighted by their angles at the vertex
  // The same, weighted by the sine of the angle, divided by the lengths of both sides (Max 1999),
  // which is exact where the vertices lie on a sphere.
  Vec3 of_sphere;
};

// Returns the unit normal at `here` of the cubic surface that is closest to points round it, as far
// as it is much closer than a quadric; else that of the quadric, as far as it is much closer than a
// plane; else the mean by angles, as where the points have noise. The order of the points changes
// last bits only.
Vec3 smooth_normal(const Vec3& here, std::span<const Vec3> around, const TriangleNormals& of);

}  // namespace medial
