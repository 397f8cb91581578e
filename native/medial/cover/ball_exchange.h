// SPDX-License-Identifier: GPL-3.0-or-later
// Better balls in place of chosen ones.
#pragma once

#include <span>
#include <vector>

#include "cover/ball_places.h"
#include "inside/solid_lattice.h"

namespace medial {

struct Exchange {
  std::span<const Ball> balls;
  std::span<const int32_t> ids;          // of the balls that may be chosen
  std::span<const BoundedPlace> places;  // none may be farther from the chosen balls than the limit
  double bound = 0;                      // that `bound` sets it, unless it is already
};

// Replaces chosen balls, one after the other, by those that hold the most places of the lattice
// that all others leave, as long as the volume grows. It ends when no ball is replaced, or after a
// few rounds.
void exchange_balls(const Exchange& exchange, std::vector<int32_t>& chosen,
                    const SolidLattice& whole, const Run& run);

}  // namespace medial
