// SPDX-License-Identifier: GPL-3.0-or-later
// Values per cell of the complex such that no cell has a larger one than any that goes after it and
// had to wait for it. Then what is above any threshold has the topology of the whole.
#pragma once

#include "skeleton/wires.h"

namespace medial {

// By which facets go; see LevelOptions.
struct Thickness {
  float sheet = 0, spacings = 0, erosion = 0;
};

// Cells that go together have one value: an edge has that of the facet or vertex it went with.
// Cells that stay have an infinite one.
struct Values {
  Array<Thickness> facet, vertex;

  Thickness of_edge(int32_t partner) const;
};

// The values of facets, and of vertices the largest of the facets at them.
Values with_vertices(const InnerComplex& complex, Array<Thickness> facets, const Run& run);

// The values of vertices become the largest of all cells that had to go before, including the wires
// that led to them.
void go_along(const Wires& wires, const InnerComplex& complex, const Collapse& collapse,
              Values& values, const Run& run);

}  // namespace medial
