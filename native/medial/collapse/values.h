// SPDX-License-Identifier: GPL-3.0-or-later
// Assigns values to the cells of the complex such that no cell has a larger value than a cell that
// had to wait for it. So the cells above any threshold have the topology of the whole.
#pragma once

#include "collapse/wires.h"

namespace medial {

// Holds the measures by which facets are removed; see LevelOptions.
struct Thickness {
  float sheet = 0, spacings = 0, erosion = 0;
};

// Cells that are removed together have one value: an edge has the value of the facet or vertex that
// it was removed with. Cells that stay have an infinite value.
struct Values {
  Array<Thickness> facet, vertex;

  Thickness of_edge(int32_t partner) const;
};

// Returns the values of facets, and for each vertex the largest value of the facets at it.
Values with_vertices(const InnerComplex& complex, Array<Thickness> facets, const Run& run);

// Raises the value of each vertex to the largest of all cells that had to be removed before it,
// including the wires that led to it.
void go_along(const Wires& wires, const InnerComplex& complex, const Collapse& collapse,
              Values& values, const Run& run);

}  // namespace medial
