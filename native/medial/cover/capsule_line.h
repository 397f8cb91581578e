// SPDX-License-Identifier: GPL-3.0-or-later
// Lines below and above points, for lengths that change linearly along a segment.
#pragma once

#include <span>
#include <vector>

namespace medial {

// A length at a share of a segment, 0 at its first end and 1 at its second.
struct LengthAt {
  double share = 0, length = 0;
};

// A linear length, by its values at both ends.
struct LinearLength {
  double first = 0, second = 0;

  double at(double share) const { return (1 - share) * first + share * second; }
};

// Returns, of the lines that are nowhere above a point, the one that is highest in the middle.
// There must be points at shares of at most and of at least 1/2.
LinearLength highest_below(const std::vector<LengthAt>& points);

// Returns, of the lines that are nowhere below a point, the one that is lowest in the middle.
LinearLength lowest_above(std::vector<LengthAt> points);

}  // namespace medial
