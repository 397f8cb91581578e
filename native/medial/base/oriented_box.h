// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes in any orientation, which fit slanted triangles far better than boxes along the axes.
#pragma once

#include <span>

#include "base/vec3.h"

namespace medial {

struct OrientedBox {
  std::array<Vec3, 3> axis{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  // unit, at right angles
  Vec3 centre;
  std::array<double, 3> half{};

  const Vec3& longest_axis() const {
    return axis[std::max_element(half.begin(), half.end()) - half.begin()];
  }
};

// Returns the squared distance from a point to a box, which is 0 inside.
inline double squared_distance(const OrientedBox& box, const Vec3& x) {
  const Vec3 away = x - box.centre;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double beyond = std::max(std::abs(dot(box.axis[i], away)) - box.half[i], 0.0);
    sum += beyond * beyond;
  }
  return sum;
}

// Returns the box round some points, at least one, with its first axis along `normal`, unless that
// is zero, and its second one towards the farthest point from the first one.
OrientedBox oriented_box(const Vec3& normal, std::span<const Vec3> points);

}  // namespace medial
