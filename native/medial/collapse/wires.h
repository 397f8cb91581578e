// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 3 of the collapse is the fire on the edges that have no facet left.
#pragma once

#include "collapse/fire.h"

namespace medial {

struct Wires {
  // Vertices are in the order in which they were removed, each with an edge.
  Array<int32_t> order;
  Array<int32_t> next;  // for each of these, the other end of the edge
  // For each vertex removed here, how much later the fire comes to the middle of the edge along the
  // wire than sideways; it means nothing for other vertices.
  Array<double> elongation;
};

// Removes all wires that the fire can reach. The rest has no loose end: closed curves, closed
// sheets and the cells that join them; one vertex stays of a tree. Other threads may read partners
// at the same time by shared_load: edges that were removed with a facet keep theirs.
Wires burn_wires(const InnerComplex& complex, const Burning& burning, Collapse& collapse,
                 const Run& run);

}  // namespace medial
