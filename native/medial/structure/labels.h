// SPDX-License-Identifier: GPL-3.0-or-later
// The label of a facet is the pair of patches between which it lies.
#pragma once

#include "structure/facets.h"

namespace medial {

// Returns the label of each facet, lower patch first. A facet with a generator where patches meet
// has the label that its other generator suggests, or that of the neighbours with which it shares
// the longest edges; twice -1 if there is none.
std::vector<Edge> labels_of(const Facets& facets, const Run& run);

}  // namespace medial
