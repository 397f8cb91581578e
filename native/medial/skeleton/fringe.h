// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 1 of the collapse: what MEDIAL does not select, as far as the topology lets it go.
#pragma once

#include "skeleton/collapse.h"
#include "skeleton/weight.h"

namespace medial {

// Takes facets away that are not selected, in rounds: in each all of them that have a free edge
// go at once, each through that of its free edges which lies deepest in the fringe, with the
// smallest ball at an end. Facets of a higher level of weight wait for those of lower levels, so
// that the wires that stay lead through the more significant ones. Which facets go does not depend
// on the order, for an edge once free stays so.
void peel_facets(const InnerComplex& complex, const FacetWeights& weight, Collapse& collapse,
                 const Run& run);

// Takes the wires away that have a loose end and are not selected, in rounds from all of their
// ends. Of a tree that stands by itself one vertex stays.
void peel_wires(const InnerComplex& complex, Collapse& collapse, const Run& run);

}  // namespace medial
