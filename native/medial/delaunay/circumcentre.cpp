// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/circumcentre.h"

#include <array>
#include <cfloat>
#include <climits>

#include "base/exact_integer.h"

namespace medial {
namespace {

struct ExactVec3 {
  Integer x, y, z;
};

ExactVec3 operator-(const ExactVec3& a, const ExactVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
ExactVec3 operator+(const ExactVec3& a, const ExactVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
ExactVec3 operator*(const Integer& s, const ExactVec3& a) { return {s * a.x, s * a.y, s * a.z}; }
Integer dot(const ExactVec3& a, const ExactVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
ExactVec3 cross(const ExactVec3& a, const ExactVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

int common_last_bit(const Vec3& p) { return last_bit(p.x, p.y, p.z); }

ExactVec3 exact(const Vec3& p, int last) {
  return {times_power_of_two(p.x, last), times_power_of_two(p.y, last),
          times_power_of_two(p.z, last)};
}

// Represents an integer of any size, rounded to 62 bits: value = mantissa * 2^exponent with
// |mantissa| < 2^62.
struct Scaled {
  double mantissa = 0;
  int exponent = 0;
};

Scaled scaled(const Integer& value) {
  if (value == 0) return {};
  const Integer size = abs(value);
  const int bits = static_cast<int>(msb(size)) + 1;
  const int drop = std::max(0, bits - 62);
  const double mantissa = static_cast<double>(static_cast<long long>(Integer(size >> drop)));
  return {value < 0 ? -mantissa : mantissa, drop};
}

double quotient(const Integer& numerator, const Integer& denominator, int exponent) {
  const Scaled n = scaled(numerator), d = scaled(denominator);
  return n.mantissa == 0 ? 0
                         : std::ldexp(n.mantissa / d.mantissa, n.exponent - d.exponent + exponent);
}

// Returns the centre relative to d.
Vec3 exact_circumcentre(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int last =
      std::min({common_last_bit(a), common_last_bit(b), common_last_bit(c), common_last_bit(d)});
  const ExactVec3 origin = exact(d, last);
  const ExactVec3 u = exact(a, last) - origin, v = exact(b, last) - origin,
                  w = exact(c, last) - origin;
  const ExactVec3 vw = cross(v, w);
  const ExactVec3 numerator = dot(u, u) * vw + dot(v, v) * cross(w, u) + dot(w, w) * cross(u, v);
  const Integer denominator = 2 * dot(u, vw);
  return {quotient(numerator.x, denominator, last), quotient(numerator.y, denominator, last),
          quotient(numerator.z, denominator, last)};
}

Vec3 exact_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const int last = std::min({common_last_bit(a), common_last_bit(b), common_last_bit(c)});
  const ExactVec3 origin = exact(a, last);
  const ExactVec3 n = cross(exact(b, last) - origin, exact(c, last) - origin);
  const std::array<Scaled, 3> parts{scaled(n.x), scaled(n.y), scaled(n.z)};
  int top = INT_MIN;
  for (const Scaled& s : parts) {
    if (s.mantissa != 0) top = std::max(top, s.exponent + std::ilogb(s.mantissa));
  }
  if (top == INT_MIN) return {};
  const auto part = [&](const Scaled& s) {
    return s.mantissa == 0 ? 0 : std::ldexp(s.mantissa, s.exponent - top);
  };
  return normalized(Vec3{part(parts[0]), part(parts[1]), part(parts[2])});
}

// This bounds the rounding of the formulas below, in units of DBL_EPSILON: three differences, two
// products of three factors, and sums of up to nine terms make less than 16.
constexpr double kOperations = 16;  // derived: 3 + 2 * 2 + 9 roundings

}  // namespace

Circumcentre circumcentre(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                          double coarsest) {
  const Vec3 u = a - d, v = b - d, w = c - d;
  const Vec3 vw = cross(v, w);
  const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  const double determinant = dot(u, vw);
  const Vec3 relative = (0.5 / determinant) * (uu * vw + vv * cross(w, u) + ww * cross(u, v));
  // The error of the centre is at most 4 * kOperations * epsilon * |u||v||w| / |determinant| *
  // radius.
  const double share =
      4 * kOperations * DBL_EPSILON * std::sqrt(uu * vv * ww) / std::abs(determinant);
  if (share <= coarsest) {
    const double rounding = DBL_EPSILON * (max_abs(d) + max_abs(relative));
    return {d + relative, share * length(relative) + rounding};
  }
  const Vec3 centre = exact_circumcentre(a, b, c, d);
  return {d + centre, 4 * DBL_EPSILON * (max_abs(d) + max_abs(centre))};
}

UnitNormal unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, n = cross(u, v);
  const double size = length(n);
  const double share = kOperations * DBL_EPSILON * std::sqrt(dot(u, u) * dot(v, v)) / size;
  if (share <= kCoarsestError) return {(1 / size) * n, share};
  return {exact_normal(a, b, c), 4 * DBL_EPSILON};
}

}  // namespace medial
