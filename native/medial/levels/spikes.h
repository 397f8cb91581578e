// SPDX-License-Identifier: GPL-3.0-or-later
// The opening of the sheets, as in image processing. A facet of erosion thickness e lies in a disc
// of its sheet of about that radius, and vouches for all that lies there; the value of a facet is
// the largest e that vouches for it. So spikes at the rim of a broad sheet have small values, while
// an ear has a large one nearly up to its rim.
#pragma once

#include "collapse/collapse.h"

namespace medial {

struct SpikeValues {
  Array<float> facet;   // share of the diagonal; infinite for facets that stay
  Array<float> vertex;  // the largest value of the facets at it and of the wires that led to it

  // Returns the value of an edge with this partner.
  float of_edge(int32_t partner) const {
    if (partner == kAlone) return HUGE_VALF;
    return partner >= 0 ? facet[partner] : vertex[with_vertex(partner)];
  }
};

// Computes the values. `partner` is as in Collapse; `thickness` is the erosion thickness of each
// facet itself as a share of the diagonal, 0 where it is not in K1, infinite where it did not burn.
// No cell has a larger value than a cell that had to wait for it.
SpikeValues spike_values(const InnerComplex& complex, std::span<const int32_t> partner,
                         std::span<const float> thickness, const Run& run);

}  // namespace medial
