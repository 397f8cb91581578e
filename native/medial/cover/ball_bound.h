// SPDX-License-Identifier: GPL-3.0-or-later
// Few balls from which no place is farther than a bound, and the least bound that a number of balls
// reaches.
#pragma once

#include <span>
#include <vector>

#include "base/run.h"
#include "cover/ball_places.h"

namespace medial {

struct BoundedBalls {
  double bound = 0;             // all places are within the limit that it sets them
  std::vector<int32_t> chosen;  // ids, in the order in which they were chosen
};

// Looks for at most `most` of the balls that serve all places within a smaller bound than the
// `first` ones, and returns the best that it finds, within 1 % of the least bound of this search,
// or less than `fine`. Always the remaining place that is farthest from the largest ball is served
// next, so ends come first; of the balls within the bound of it, the one that serves most of the
// remaining places is taken.
BoundedBalls bounded_balls(std::span<const Ball> balls, std::span<const int32_t> ids,
                           std::span<const BoundedPlace> places, int64_t most, double fine,
                           BoundedBalls first, const Run& run);

}  // namespace medial
