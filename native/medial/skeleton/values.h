// A value per cell of the complex such that no cell has a larger one than any that goes after it
// and had to wait for it. Then what is above any threshold has the topology of the whole.
#pragma once

#include "skeleton/wires.h"

namespace medial {

// What goes together has one value: the one of an edge is that of the facet or vertex it went
// with. Infinite for what stays.
struct Values {
  Array<float> facet, vertex;

  float of_edge(int32_t partner) const {
    if (partner == kAlone) return HUGE_VALF;
    return partner >= 0 ? facet[partner] : vertex[with_vertex(partner)];
  }
};

// The values of facets, and of vertices the largest of all that had to go before: the facets at
// them and the wires that led to them.
Values with_vertices(const InnerComplex& complex, const Collapse& collapse, const Wires& wires,
                     Array<float> facets, const Run& run);

}  // namespace medial
