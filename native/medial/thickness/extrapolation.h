// SPDX-License-Identifier: GPL-3.0-or-later
// Values of some samples are carried to the others along the surface.
#pragma once

#include "axis/significance.h"
#include "thickness/tangent_balls.h"

namespace medial {

// Gives each sample with an infinite value that of the nearest sample with a finite one. Samples
// with no wall nearby, as on a cube, where only the centres face each other, get the largest nearby
// ball of `own`. Nearby means no farther away than kReach times the value, along the short Delaunay
// edges between samples that do not face away from each other: such edges follow the surface and
// cross neither walls nor gaps. Where no ball is larger than the value, it goes twice as far, and
// some edges on.
void extrapolate(std::vector<double>& values, std::span<const double> own,
                 std::span<const Vec3> points, const Tangents& tangents, const Edges& edges,
                 const Significance& significance, const Run& run);

// At a right edge of a plate the farthest place without a wall is the middle of its rim, as far
// from the nearest wall as the plate is thick; at sharper edges it is farther.
inline constexpr double kReach = 2;  // chosen: unseen

}  // namespace medial
