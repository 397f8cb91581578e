// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 0 of the collapse: samples inside the solid have a 3-cell each, and every 3-cell is opened
// through a facet.
#pragma once

#include "skeleton/collapse.h"
#include "skeleton/weight.h"

namespace medial {

// Takes one facet per 3-cell away, from outside inwards, always the facet of least weight (equal
// ones: the lower id): of the walls about any 3-cell the weakest way out is opened, as in Prim's
// spanning tree.
void open_bubbles(const InnerComplex& complex, const FacetWeights& weight, Collapse& collapse,
                  const Run& run);

}  // namespace medial
