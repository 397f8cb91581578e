// SPDX-License-Identifier: GPL-3.0-or-later
// Circumcentres and triangle normals that stay right for nearly flat simplices: doubles with an
// error bound, and exact integer arithmetic where the bound is too large.
#pragma once

#include "base/vec3.h"

namespace medial {

// Coarsest relative error that is let through: that of a float, the precision in which meshes are
// stored.
inline constexpr double kCoarsestError = 0x1p-24;
// The same where a facet stands or falls with it: whether two centres are one, or three on a line.
inline constexpr double kFinestError = 0x1p-40;

struct Circumcentre {
  Vec3 centre;
  double error;  // the exact centre is no farther than this
};

// Centre of the sphere through four points that are not coplanar; error <= coarsest * radius, plus
// the rounding of absolute coordinates.
Circumcentre circumcentre(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                          double coarsest = kCoarsestError);

struct UnitNormal {
  Vec3 direction;
  double error;  // the exact unit normal is no farther than this
};

// (b - a) x (c - a), normalized; zero for collinear points.
UnitNormal unit_normal(const Vec3& a, const Vec3& b, const Vec3& c);

// The circumradius of a triangle. Do not compare its square with the squared radius below, which
// takes no roots and is rounded differently.
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
