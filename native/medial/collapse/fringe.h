// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 1 of the collapse removes the cells that MEDIAL does not select, if the topology allows it.
#pragma once

#include "collapse/collapse.h"
#include "collapse/weight.h"

namespace medial {

// Removes facets that are not selected, in rounds. A round removes at once all of them that have a
// free edge, each through the free edge that is deepest in the fringe, with the smallest ball at an
// end. Facets of a higher level of weight wait for those of lower levels, so that the wires that
// stay lead through the more significant facets. The set of removed facets does not depend on the
// order, because a free edge stays free.
void peel_facets(const InnerComplex& complex, const FacetWeights& weight, Collapse& collapse,
                 const Run& run);

// Removes the wires that have a loose end and are not selected, in rounds from all of their ends.
// One vertex of an isolated tree stays.
void peel_wires(const InnerComplex& complex, Collapse& collapse, const Run& run);

}  // namespace medial
