// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet is a part of K1 that is connected over edges with exactly two facets. It is dropped as a
// whole, when its thickest facet is.
#pragma once

#include "collapse/fire.h"

namespace medial {

// Identifies a facet of K1 at an edge where three or more facets meet.
struct AtJunction {
  int32_t edge, facet;

  friend auto operator<=>(const AtJunction&, const AtJunction&) = default;
};

struct Sheets {
  Array<int32_t> of_facet;  // per facet: the lowest facet of its sheet, or -1 if it is not in K1
  std::vector<AtJunction> junctions;  // ascending
};

// Finds the sheets; call it before the fire.
Sheets find_sheets(const InnerComplex& complex, const Collapse& collapse, const Run& run);

// Returns for each facet the value up to which sheets must be dropped until it is removed, with
// those that must be removed before it; 0 for facets that are not in K1, infinity for those that
// did not burn. `thickness` is per facet, in any unit; the value of a sheet is that of its thickest
// facet. Sheets are dropped one after the other, the thinnest first; where one ends at a junction,
// the other two unite. Wires may burn in parallel.
Array<float> drop_values(const InnerComplex& complex, const Collapse& collapse,
                         const Sheets& sheets, std::span<const float> thickness, const Run& run);

}  // namespace medial
