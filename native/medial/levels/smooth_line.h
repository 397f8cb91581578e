// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth line has the least sum of squares of deviations from given places and of weighted fourth
// differences (Whittaker 1923).
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"

namespace medial {

// Returns as many places as are given, in even steps. Waves of 2 pi times `widths` steps lose half
// their height there; the first two and the last two widths do not matter.
std::vector<Vec3> smooth_line(std::span<const Vec3> places, std::span<const double> widths);

}  // namespace medial
