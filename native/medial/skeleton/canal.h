// SPDX-License-Identifier: GPL-3.0-or-later
// Fits a piece of a canal surface to the samples round a point of a curve: the surface of balls of
// changing radius whose centres lie on a bent axis. On round limbs it gives the axis far more
// exactly than Voronoi vertices; where the samples do not lie all round, it leaves things be.
#pragma once

#include "base/point_tree.h"

namespace medial {

// Near its centre the axis is c(t) = centre + t tangent + (t / half width)^2 bend, and the ball
// there has the radius radius + t slope + t^2 flare.
struct Canal {
  Vec3 centre{};
  double radius = 0, slope = 0, flare = 0;
  Vec3 tangent{};
  Vec3 bend{};
  // How much of it the samples tell: 1 where they lie all round, 0 where they do not.
  double trust = 0;
};

// The steepest slope of the radius that is fitted. The steeper a canal, the farther from its centre
// its ball touches the surface.
inline constexpr double kSteepest = 0.9;

// One step from a canal that is nearly right. Uses samples that touch balls up to `half_width`
// before and behind it.
Canal fit_canal(const PointTree& samples, const Canal& from, double half_width);

}  // namespace medial
