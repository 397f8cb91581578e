// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/oriented_box.h"

namespace medial {
namespace {

constexpr double kUpright = 0x1p-40;  // squared: what is across the normal; derived: rounding

}  // namespace

OrientedBox oriented_box(const Vec3& normal, std::span<const Vec3> points) {
  Vec3 farthest;
  for (const Vec3& p : points) {
    const Vec3 away = p - points[0];
    if (squared_length(away) > squared_length(farthest)) farthest = away;
  }
  OrientedBox box;
  const Vec3 n = normal == Vec3{} ? box.axis[2] : normalized(normal);
  const Vec3 flat = farthest - dot(farthest, n) * n;
  // If the direction is that of the normal, only rounding is left, which may point anywhere.
  const bool upright = squared_length(flat) <= kUpright * squared_length(farthest);
  box.axis = {n, upright ? across(n)[0] : normalized(flat - dot(flat, n) * n), {}};
  box.axis[2] = cross(n, box.axis[1]);
  box.centre = points[0];
  for (int i = 0; i < 3; ++i) {
    double low = 0, high = 0;
    for (const Vec3& p : points) {
      const double at = dot(box.axis[i], p - points[0]);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    box.centre = box.centre + (0.5 * low + 0.5 * high) * box.axis[i];
    box.half[i] = 0.5 * high - 0.5 * low;
  }
  return box;
}

}  // namespace medial
