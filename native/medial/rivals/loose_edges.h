// SPDX-License-Identifier: GPL-3.0-or-later
// The edges without a facet of the lambda-medial axis (Chazal & Lieutier 2005), of curves.
#pragma once

#include "rivals/size_selection.h"

namespace medial {

// Voronoi edges, as the lowest cells of their two Voronoi vertices, whose nearest samples fit in no
// ball that is smaller than the selection asks for, and none of whose facets is among `generators`
// (input rows, ascending). Their three facets are bounded and lie on the side that is wanted. In
// the order of the rows of their samples. `row`: of each sample.
std::vector<Edge> loose_edges(const SizeSelection& selection, std::span<const Edge> generators,
                              std::span<const int32_t> row, const Run& run);

}  // namespace medial
