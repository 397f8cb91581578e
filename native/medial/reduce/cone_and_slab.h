// SPDX-License-Identifier: GPL-3.0-or-later
// Slabs, cones and balls are the envelopes of balls whose centres move over a triangle, a segment
// or a point, with linear radii.
#pragma once

#include <array>
#include <span>

#include "base/vec3.h"

namespace medial {

struct Sphere {
  Vec3 centre;
  double radius = 0;
};

// Describes the ball of an envelope that is nearest to a query, by the shares of its spheres.
struct NearestOfEnvelope {
  double distance = HUGE_VAL;  // signed: negative inside that ball
  std::array<double, 3> shares{};
};

// Returns the nearest ball of the envelope of 1 to 3 spheres. The distance to a ball is convex in
// its shares, so there is one minimum.
NearestOfEnvelope nearest_ball(std::span<const Sphere> spheres, const Vec3& query);

// Holds the outward normals of the two planes that are tangent to three spheres. There are none if
// one of the spheres, or a cone of two of them, contains the rest of the slab.
struct TangentNormals {
  bool exist = false;
  std::array<Vec3, 2> normals;
};
TangentNormals tangent_normals(const Sphere& a, const Sphere& b, const Sphere& c);

}  // namespace medial
