// SPDX-License-Identifier: GPL-3.0-or-later
// Samples are analysed in a frame, moved and scaled so that no power of a length overflows or
// underflows a double, and a large offset costs no precision.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"

namespace medial {

// Coordinates inside a frame are multiples of this power of two of the extent, 1 / 2^160 or about
// 7e-49. Rows that differ by less are merged.
inline constexpr int kFinestBits = 160;

struct Frame {
  Vec3 origin;        // is 0 along an axis unless all differences to it are exact
  int exponent = 0;   // the unit is 2^exponent
  double finest = 0;  // coordinates inside are multiples of it; 0 means no rounding

  bool is_plain() const { return origin == Vec3{} && exponent == 0 && finest == 0; }

  Vec3 inward(const Vec3& p) const;
  Vec3 outward(const Vec3& p) const;
  double inward(double length) const;
  double outward(double length) const;
  std::vector<Vec3> inward(std::span<const Vec3> rows) const;
};

// Returns the frame whose origin is the middle of the box along each axis where that is exact:
// where all coordinates are within a factor of two. Otherwise the box is no farther from 0 than its
// size, and the origin stays. The unit is a power of two if the extent is beyond 2^-64 or 2^64, and
// coordinates are rounded to the finest step if some are finer. The rows must be finite.
Frame frame_of(std::span<const Vec3> rows, std::span<const Vec3> more_rows);

}  // namespace medial
