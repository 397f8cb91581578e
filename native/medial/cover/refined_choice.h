// SPDX-License-Identifier: GPL-3.0-or-later
// Balls that leave no place of a solid far away, and then hold as much of it as they can.
#pragma once

#include <span>

#include "cover/ball_choice.h"

namespace medial {

// Chooses at most `count` balls, in the order of the volume that they add. A share of them bounds
// the distance of all places, the others hold most of the volume that is left; then balls are
// exchanged for those that hold more within that bound. With share 1 the bound is all that counts.
// The places of the balls are removed from the lattice.
BallChoice balls_by_bound(std::span<const Ball> balls, int64_t count, double share,
                          std::span<const Vec3> places, SolidLattice& left, const Run& run);

}  // namespace medial
