// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth line has the least sum of squares of deviations from given places and of weighted fourth
// differences (Whittaker 1923).
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"

namespace medial {

// Returns as many places as are given, in even steps. Waves of 2 pi times as many steps as
// `widths` has at a place lose half their height there; the first and the last two have none.
std::vector<Vec3> smooth_line(std::span<const Vec3> places, std::span<const double> widths);

}  // namespace medial
