// SPDX-License-Identifier: GPL-3.0-or-later
// Which of many balls in a solid cover it best. Both orders do not depend on how many are wanted.
#pragma once

#include <span>
#include <vector>

#include "base/nearest_ball.h"
#include "base/run.h"
#include "inside/solid_lattice.h"

namespace medial {

struct BallChoice {
  std::vector<int32_t> chosen;  // (n) ids, in the order in which they were chosen
  std::vector<double> covered;  // (n) share of the places that the first 1, 2, ... n balls hold
};

// Each ball is the one that holds most of the places that are left, of equal ones the first: any n
// hold no more than 1 / (1 - 1/e) of what the first n hold. What they hold is taken from the
// lattice. Ends where all have been taken that any ball holds.
BallChoice balls_by_volume(std::span<const Ball> balls, int64_t count, SolidLattice& left,
                           const Run& run);

// After the first ball, which is the same: of those that come near to the place that is farthest
// from all before, the one that holds most of what is left. Ends where no place can come nearer.
BallChoice balls_by_distance(std::span<const Ball> balls, int64_t count, SolidLattice& left,
                             const Run& run);

}  // namespace medial
