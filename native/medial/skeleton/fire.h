// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 2 of the collapse: a fire that starts at the rims of K1, each point of which burns first
// after a time that is the radius of its ball, and spreads with unit speed. Where three sheets meet
// it waits for the second (Yan, Sykes, Chambers, Letscher & Ju 2016). The erosion thickness of a
// facet is how much later than the radius of the ball at its centroid the fire comes there.
#pragma once

#include "skeleton/collapse.h"

namespace medial {

// Times at the ends of an edge, in the order of its ends.
using Times = std::array<double, 2>;

struct Burning {
  // Per edge: when it became free, as the fire has it; for those that never had a facet in K1 the
  // radii. Without meaning for edges that are not free at the end.
  Array<Times> times;
  Array<uint8_t> is_wire;  // per edge: it has no facet any more
  // Per facet: erosion thickness; infinite for those that did not burn, 0 for those not in K1.
  Array<double> thickness;
  // The same, never less than that of any facet that had to go before.
  Array<float> erosion;  // shares of the diagonal
};

// Takes all facets away that fire can reach. What it does not are closed sheets. Of the collapse,
// `facets_at` is gone afterwards.
Burning burn(const InnerComplex& complex, std::span<const Vec3> points, Collapse& collapse,
             const Run& run);

}  // namespace medial
