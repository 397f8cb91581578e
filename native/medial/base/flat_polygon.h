// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of polygons in the plane, which rounding must not decide.
#pragma once

#include <span>

namespace medial {

struct FlatPoint {
  double x = 0, y = 0;
};

// Returns whether a polygon runs clockwise round a larger area than rounding could cause.
bool is_turned_over(std::span<const FlatPoint> corners);
// Returns whether a polygon turns right at a corner by more than an angle of this sine.
bool has_dent(std::span<const FlatPoint> corners, double sine);
// Returns whether a side runs back along the one before it.
bool turns_back(std::span<const FlatPoint> corners);
// Returns whether two sides that are no neighbours cross inside both.
bool crosses_itself(std::span<const FlatPoint> corners);

// Returns whether all corners are on one line, or at one point.
bool is_on_line(std::span<const FlatPoint> corners);

}  // namespace medial
