// SPDX-License-Identifier: GPL-3.0-or-later
// A wire of a bar is where its walls hold a ball from all sides: the largest ball of the section.
// Samples show this place only as well as they lie close to each other.
#pragma once

#include "exact/empty_ball.h"

namespace medial {

// Climbs from a place, across a direction, to where the distance to the faces grows no more: to the
// ball that they hold, or that nearly parallel ones touch on two sides. If this ball does not
// contain the place, or smooth walls do not tell it better than samples, the ball stays there, and
// only its radius is that of the walls. The radius is 0 where the place is not inside.
Touch held_ball(const SamplesOnFaces& samples, const Vec3& start, const Vec3& along);

}  // namespace medial
