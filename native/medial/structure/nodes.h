// SPDX-License-Identifier: GPL-3.0-or-later
// The nodes of an axis: junctions, where three or more seams meet, and corners, where a seam
// reaches a crease.
#pragma once

#include "structure/curves.h"

namespace medial {

struct AxisNode {
  PlaceKind kind = PlaceKind::junction;
  int32_t vertex = -1;
  std::vector<int32_t> curves;  // long ones, ascending
};

// Joins curves between the same parts that a short piece of others interrupts.
void join_curves(const Facets& facets, AxisCurves& curves);

// Finds the nodes. Places where curves meet are one node if they are less than 1.5 spacings apart.
std::vector<AxisNode> nodes_of(const Facets& facets, const AxisCurves& curves);

}  // namespace medial
