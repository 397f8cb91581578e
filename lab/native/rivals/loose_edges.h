// SPDX-License-Identifier: GPL-3.0-or-later
// These are the edges without a facet of the lambda-medial axis (Chazal & Lieutier 2005), of
// curves.
#pragma once

#include "rivals/size_selection.h"

namespace medial {

// Returns Voronoi edges, as the lowest cells of their two Voronoi vertices, whose nearest samples
// fit in no ball smaller than the selection demands, and none of whose facets is among `generators`
// (input rows, ascending). Their three facets are bounded and lie on the wanted side. They are in
// the order of the rows of their samples; `row` is that of each sample.
std::vector<Edge> loose_edges(const SizeSelection& selection, std::span<const Edge> generators,
                              std::span<const int32_t> row, const Run& run);

}  // namespace medial
