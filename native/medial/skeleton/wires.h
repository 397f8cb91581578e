// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 3 of the collapse: the fire on the edges that have no facet any more.
#pragma once

#include "skeleton/fire.h"

namespace medial {

struct Wires {
  // Vertices in the order in which they went, each with the edge that it went with.
  Array<int32_t> order;
  Array<int32_t> next;  // of each of these, the other end of that edge
  // Per vertex that went here: how much later than sideways the fire comes along the wire to the
  // middle of the edge; without meaning for others.
  Array<double> elongation;
};

// Takes all wires away that fire can reach. What is left has no loose end: closed curves, closed
// sheets and what joins them; of a tree one vertex. Others may read partners at the same time, by
// shared_load: edges that have gone with a facet keep theirs.
Wires burn_wires(const InnerComplex& complex, const Burning& burning, Collapse& collapse,
                 const Run& run);

}  // namespace medial
