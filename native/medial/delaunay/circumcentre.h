// SPDX-License-Identifier: GPL-3.0-or-later
// Computes circumcentres and triangle normals that stay right for nearly flat simplices: with
// doubles and an error bound, or with exact integers where the bound is too large.
#pragma once

#include "base/vec3.h"

namespace medial {

// This is the largest relative error that is accepted: that of a float, the precision in which
// meshes are stored.
inline constexpr double kCoarsestError = 0x1p-24;  // derived: a float
// This is the accepted error where the existence of a facet depends on it: whether two centres are
// one, or three are on a line.
inline constexpr double kFinestError = 0x1p-40;  // derived: rounding

struct Circumcentre {
  Vec3 centre;
  double error;  // the exact centre is at most this far away
};

// Returns the centre of the sphere through four points that are not coplanar. The error is at most
// coarsest * radius, plus the rounding of absolute coordinates.
Circumcentre circumcentre(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                          double coarsest = kCoarsestError);

struct UnitNormal {
  Vec3 direction;
  double error;  // the exact unit normal is at most this far away
};

// Returns (b - a) x (c - a), normalized; it is zero for collinear points.
UnitNormal unit_normal(const Vec3& a, const Vec3& b, const Vec3& c);

// Returns the circumradius of a triangle. Do not compare its square with the squared radius below,
// which takes no roots and is rounded differently.
inline double circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double twice_area = length(cross(u, v));
  return length(u) * length(v) * distance(b, c) / (2 * twice_area);
}
inline double squared_circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  return squared_length(u) * squared_length(v) * squared_length(c - b) /
         (4 * squared_length(cross(u, v)));
}

}  // namespace medial
