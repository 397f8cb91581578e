// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets: the parts of K1 that hang together over edges with exactly two facets. A sheet is dropped
// whole, when its thickest facet is.
#pragma once

#include "skeleton/fire.h"

namespace medial {

// A facet of K1 at an edge where three or more of them meet.
struct AtJunction {
  int32_t edge, facet;

  friend auto operator<=>(const AtJunction&, const AtJunction&) = default;
};

struct Sheets {
  Array<int32_t> of_facet;            // the lowest facet of its sheet; -1: not in K1
  std::vector<AtJunction> junctions;  // ascending
};

// Before the fire.
Sheets find_sheets(const InnerComplex& complex, const Collapse& collapse, const Run& run);

// Per facet: the value up to which a sheet has to be dropped for it to go, with what has to go
// before; 0 for facets that are not in K1, infinite for those that did not burn. `thickness` is per
// facet, in any unit; the value of a sheet is that of its thickest facet. Sheets go one after the
// other, the thinnest first; where one ends at a junction, the other two become one. Wires may burn
// beside it.
Array<float> drop_values(const InnerComplex& complex, const Collapse& collapse,
                         const Sheets& sheets, std::span<const float> thickness, const Run& run);

}  // namespace medial
