// SPDX-License-Identifier: GPL-3.0-or-later
// The frame in which samples are analysed: moved and scaled so that no power of a length leaves the
// range of a double, and no place is rounded to the last bits of an offset.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"

namespace medial {

// Inside a frame nothing is smaller than this share of the extent: coordinates are its multiples.
// Rows that differ by less are one. 1 / 2^160 is about 7e-49.
inline constexpr int kFinestBits = 160;

struct Frame {
  Vec3 origin;        // 0 along an axis on which the differences to it are not all exact
  int exponent = 0;   // 2^exponent is the unit
  double finest = 0;  // of which coordinates inside are multiples; 0: they need not be rounded

  bool is_plain() const { return origin == Vec3{} && exponent == 0 && finest == 0; }

  Vec3 inward(const Vec3& p) const;
  Vec3 outward(const Vec3& p) const;
  double outward(double length) const;
  std::vector<Vec3> inward(std::span<const Vec3> rows) const;
};

// The plain frame for all but extreme coordinates, which leaves every bit as it is. Otherwise: the
// unit is a power of two, for an extent beyond 2^-64 or 2^64; the origin is moved where the offset
// is 2^20 times the extent or more, for then all differences are exact; and coordinates are rounded
// to the finest step where some lie below it. Rows are finite.
Frame frame_of(std::span<const Vec3> rows, std::span<const Vec3> more_rows);

}  // namespace medial
