// SPDX-License-Identifier: GPL-3.0-or-later
// These functions choose the balls that cover a solid best. Both orders are independent of the
// wanted number.
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

// Each ball is the one that holds the most remaining places, ties by order: any n hold no more than
// 1 / (1 - 1/e) of what the first n hold. Their places are removed from the lattice. The choice
// ends when no ball holds a remaining place.
BallChoice balls_by_volume(std::span<const Ball> balls, int64_t count, SolidLattice& left,
                           const Run& run);

// The first ball is the same. Each further one is chosen among those near the place that is
// farthest from all earlier balls: the one that holds the most remaining places. The choice ends
// when no ball comes nearer to any place.
BallChoice balls_by_distance(std::span<const Ball> balls, int64_t count, SolidLattice& left,
                             const Run& run);

}  // namespace medial
