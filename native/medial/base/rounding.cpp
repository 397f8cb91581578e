// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/rounding.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "base/rows.h"

namespace medial {

bool are_single(std::span<const Vec3> rows) {
  uint32_t bits = 0;
  for (const Vec3& p : rows) {
    for (const double x : {p.x, p.y, p.z}) {
      const auto single = static_cast<float>(x);
      if (static_cast<double>(single) != x) return false;
      bits |= std::bit_cast<uint32_t>(single);
    }
  }
  return (bits & 1) != 0;
}

double rounding_of(std::span<const Vec3> rows, double far) {
  constexpr double kRoundings = 4;  // chosen: unseen
  if (rows.empty()) return 0;
  const Box box = box_of(rows);
  const double largest = std::max(max_abs(box.low), max_abs(box.high));
  const double size = are_single(rows) ? largest : 0.5 * max_abs(box.extent());
  return kRoundings * std::max(std::numeric_limits<float>::epsilon() * size,
                               std::numeric_limits<double>::epsilon() * std::max(far, largest));
}

}  // namespace medial
