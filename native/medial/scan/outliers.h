// SPDX-License-Identifier: GPL-3.0-or-later
// Points that stand alone, by a local rule, and points at which the surface ends.
#pragma once

#include "base/point_tree.h"

namespace medial {

// Returns the ascending ids of points that stand alone: much farther from the nearest one than
// its neighbours are from theirs, and none of these has them among its own neighbours.
std::vector<int32_t> lone_points(const PointTree& tree, const Run& run);

// Returns the share of the points at which the surface ends: seen along its normal, a wide sector
// round them is empty. A neighbourhood reaches over `reach`, or over a few neighbours if these lie
// farther away.
double border_share(const PointTree& tree, double reach, const Run& run);

}  // namespace medial
