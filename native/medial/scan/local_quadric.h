// SPDX-License-Identifier: GPL-3.0-or-later
// The surface near a place is described by a quadric over a plane, fitted to points by weighted
// least squares.
#pragma once

#include <optional>
#include <span>

#include "base/vec3.h"

namespace medial {

// Heights over the plane through `origin` are c0 + c1 u + c2 v + c3 uu + c4 uv + c5 vv, in units of
// `radius`.
struct LocalQuadric {
  Vec3 origin, u, v, normal;
  double radius = 0;
  std::array<double, 6> terms{};
  double variance = 0;  // of c0, in units of that of a point; an upper bound where weights differ

  // Returns how far a point lies above the quadric, along the normal of the plane.
  double above(const Vec3& p) const;
  // Returns the place of the quadric above its origin.
  Vec3 place() const { return origin + (terms[0] * radius) * normal; }
  // Returns the unit normal of the quadric at that place.
  Vec3 tilted() const { return normalized(normal - terms[1] * u - terms[2] * v); }
};

enum class Weights { equal, smooth };  // smooth ones fall to 0 at the radius

// Returns the direction in which the points near a centre spread least, a unit vector.
Vec3 least_spread(std::span<const Vec3> points);

// Fits a quadric over the plane through `origin` that is perpendicular to the unit vector `normal`.
// Returns nothing if the points do not determine it.
std::optional<LocalQuadric> fit_quadric(std::span<const Vec3> points, const Vec3& origin,
                                        const Vec3& normal, double radius, Weights weights);

// Returns the standard deviation of points from the quadric that was fitted to them with equal
// weights, a length.
double spread(std::span<const Vec3> points, const LocalQuadric& quadric);

}  // namespace medial
