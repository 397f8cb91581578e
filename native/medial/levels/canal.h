// SPDX-License-Identifier: GPL-3.0-or-later
// Fits a piece of a canal surface to the samples around a point of a curve. A canal surface is the
// envelope of balls of changing radius whose centres lie on a bent axis. On round limbs it gives
// the axis far more exactly than Voronoi vertices; where samples do not lie all round, the axis
// stays.
#pragma once

#include "base/point_tree.h"

namespace medial {

// The axis near the centre is c(t) = centre + t tangent + (t / half width)^2 bend, and the ball at
// c(t) has the radius radius + t slope + t^2 flare.
struct Canal {
  Vec3 centre{};
  double radius = 0, slope = 0, flare = 0;
  Vec3 tangent{};
  Vec3 bend{};
  // The trust in the fit is 1 where samples lie all round, and 0 where they do not determine it.
  double trust = 0;
};

// A fit gives no steeper slope of the radius. The steeper a canal, the farther from its centre its
// ball touches the surface.
inline constexpr double kSteepest = 0.9;  // chosen: axis

// Improves a canal that is nearly right by one step. Uses samples that touch balls up to
// `half_width` before and behind its centre.
Canal fit_canal(const PointTree& samples, const Canal& from, double half_width);

}  // namespace medial
