// SPDX-License-Identifier: GPL-3.0-or-later
// This is the arithmetic of points and vectors of R^3, and of boxes.
#pragma once

#include <medial/types.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace medial {

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// The cosine between the outward normals of walls that are opposite each other, at most.
inline constexpr double kOpposite = -0.5;  // derived: cos(120 degrees), a third of a turn
// A smaller share of a length is none.
inline constexpr double kRoundingShare = 1e-12;  // derived: rounding
inline double squared_length(const Vec3& a) { return dot(a, a); }
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline double distance(const Vec3& a, const Vec3& b) { return length(a - b); }
inline double max_abs(const Vec3& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}
// The zero vector stays zero.
inline Vec3 normalized(const Vec3& a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}
// Returns two unit vectors that are perpendicular to a unit vector and to each other; the first is
// also perpendicular to the axis of its smallest coordinate.
inline std::array<Vec3, 2> across(const Vec3& unit) {
  const double x = std::abs(unit.x), y = std::abs(unit.y), z = std::abs(unit.z);
  const Vec3 least = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 first = normalized(cross(unit, least));
  return {first, cross(unit, first)};
}

inline double coordinate(const Vec3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
inline int longest_axis(const Vec3& extent) {
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

struct Box {
  Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void add(const Box& other) {
    add(other.low);
    add(other.high);
  }
  Vec3 centre() const { return 0.5 * low + 0.5 * high; }
  Vec3 extent() const { return high - low; }
};

// Returns the squared distance from a point to a box, which is 0 inside.
inline double squared_distance(const Box& box, const Vec3& x) {
  const auto beyond = [](double low, double at, double high) {
    return std::max({low - at, 0.0, at - high});
  };
  return squared_length({beyond(box.low.x, x.x, box.high.x), beyond(box.low.y, x.y, box.high.y),
                         beyond(box.low.z, x.z, box.high.z)});
}

}  // namespace medial
