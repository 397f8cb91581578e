// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the stages 2 and 3 of the collapse, and finds the values of all cells.
#pragma once

#include "collapse/fire.h"
#include "levels/level.h"

namespace medial {

// How far the bar is where each stage begins. Faces and crisp places, where there are any, take
// most of the time.
struct Bar {
  double complex, fringe, fire, wires, values, crisp;
};
// The stages read this besides the complex; all of it must outlive them.
struct Fuel {
  const FacetWeights& weight;
  const RadiusInFacet& radius;
  std::span<const double> spacing;   // per sample
  double least = 0;                  // thickness of a facet that burns, as a share of the diagonal
  std::span<const float> limb = {};  // per edge: value that it has at least as a wire; or empty
};

// Burns K1, which `collapse` has left of the complex in `made`, and sets the partners, values,
// thickness and limbs there.
void burn_down(Hierarchy::Parts& made, Collapse collapse, const Fuel& fuel,
               const std::function<void()>& beside_fire, const std::function<void()>& beside_limbs,
               const Bar& bar, Stopwatch& watch, const Run& run);

}  // namespace medial
