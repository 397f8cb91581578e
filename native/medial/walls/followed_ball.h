// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the ball that touches two curved walls near a place, by following its two feet.
#pragma once

#include "walls/touching_ball.h"

namespace medial {

// Does for two curved walls what touching_ball does, in a fraction of the time: with each step of
// the centre the feet take one step of Newton's method. Returns nothing where a wall ends at a
// foot, since another wall may be nearer there, and where the steps find no ball.
std::optional<TouchingBall> followed_ball(const Faces& faces, std::span<int32_t> walls,
                                          const Vec3& start);

}  // namespace medial
