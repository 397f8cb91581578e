// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/frame.h"

#include "base/rows.h"

namespace medial {
namespace {

constexpr int kPlainBits = 64;  // extents from 2^-64 to 2^64 are not scaled

// Returns the origin along one axis. If low and high are within a factor of two, differences to
// all that lies between them are exact (Sterbenz).
double origin_of(double low, double high) {
  const bool exact = high <= 2 * low || low >= 2 * high;
  return exact ? 0.5 * low + 0.5 * high : 0;
}

double rounded(double x, double finest) {
  // Larger numbers are multiples of it already.
  return std::abs(x) < std::ldexp(finest, 53) ? finest * std::nearbyint(x / finest) : x;
}

}  // namespace

Vec3 Frame::inward(const Vec3& p) const {
  const Vec3 d = p - origin;
  Vec3 q{std::scalbn(d.x, -exponent), std::scalbn(d.y, -exponent), std::scalbn(d.z, -exponent)};
  if (finest > 0) q = {rounded(q.x, finest), rounded(q.y, finest), rounded(q.z, finest)};
  return q;
}

Vec3 Frame::outward(const Vec3& p) const {
  return Vec3{std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)} +
         origin;
}

double Frame::inward(double length) const { return std::scalbn(length, -exponent); }

double Frame::outward(double length) const { return std::scalbn(length, exponent); }

std::vector<Vec3> Frame::inward(std::span<const Vec3> rows) const {
  std::vector<Vec3> result;
  result.reserve(rows.size());
  for (const Vec3& p : rows) result.push_back(inward(p));
  return result;
}

Frame frame_of(std::span<const Vec3> rows, std::span<const Vec3> more_rows) {
  Box box;
  for (const auto& some : {rows, more_rows}) {
    for (const Vec3& p : some) box.add(p);
  }
  const double extent = max_abs(box.extent());
  Frame frame;
  if (!(extent > 0) || !std::isfinite(extent)) return frame;
  frame.origin = {origin_of(box.low.x, box.high.x), origin_of(box.low.y, box.high.y),
                  origin_of(box.low.z, box.high.z)};
  const int size = std::ilogb(extent);
  if (std::abs(size) > kPlainBits) frame.exponent = size;
  const double finest = std::ldexp(1.0, size - frame.exponent - kFinestBits);
  const auto finer = [&](const Vec3& p) {
    const Vec3 q = frame.inward(p);
    return Vec3{rounded(q.x, finest), rounded(q.y, finest), rounded(q.z, finest)} != q;
  };
  for (const auto& some : {rows, more_rows}) {
    if (std::any_of(some.begin(), some.end(), finer)) {
      frame.finest = finest;
      break;
    }
  }
  return frame;
}

}  // namespace medial
