// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 0 of the collapse: each sample inside the solid has a 3-cell, and every 3-cell is opened
// through a facet.
#pragma once

#include "collapse/collapse.h"
#include "collapse/weight.h"

namespace medial {

// Removes one facet per 3-cell, from outside inwards. It always removes the facet of least weight
// (the lower id if weights are equal), so the weakest wall around any 3-cell is opened, as in
// Prim's spanning tree.
void open_bubbles(const InnerComplex& complex, const FacetWeights& weight, Collapse& collapse,
                  const Run& run);

}  // namespace medial
