// SPDX-License-Identifier: GPL-3.0-or-later
// Cells without extent, as of cospherical samples, shrunk to what they are, by steps that each keep
// the topology: an edge without length shrinks to a point, unless it closes a loop; a facet that is
// left with one edge shrinks to a point with it; a facet that is left with two edges shrinks to one
// edge, unless both are the same already; what a facet passes to and fro does not count; a facet in
// one place goes with an edge that no other one has. So the cells about the axis of a tube, whose
// facets are segments, become a curve.
#pragma once

#include "skeleton/complex.h"

namespace medial {

// `place`: per vertex the lowest one in the same place.
InnerComplex shrink(InnerComplex complex, std::span<const int32_t> place, const Run& run);

}  // namespace medial
