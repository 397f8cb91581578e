// SPDX-License-Identifier: GPL-3.0-or-later
// Fits a piece of a canal surface to the samples round a point of a curve: the surface of balls of
// changing radius whose centres lie on a bent axis. On round limbs it gives the axis far more
// exactly than Voronoi vertices; where the samples do not lie all round, it leaves things be.
#pragma once

#include "base/point_tree.h"

namespace medial {

struct Canal {
  Vec3 centre{};
  double radius = 0;  // across the tangent
  double slope = 0;   // of the radius along the axis
  Vec3 tangent{};     // of the axis
  Vec3 bend{};        // how far the axis is away from the tangent, half a width on
  // How much of it the samples tell: 1 where they lie all round, 0 where they do not.
  double trust = 0;
};

// Of the ball that touches the canal: less than its radius where that changes along the axis.
inline double radius_of_ball(const Canal& canal) {
  return canal.radius / std::sqrt(1 + canal.slope * canal.slope);
}

// One step from a canal that is nearly right. Uses samples up to `half_width` before and behind it.
Canal fit_canal(const PointTree& samples, const Canal& from, double half_width);

}  // namespace medial
