// SPDX-License-Identifier: GPL-3.0-or-later
// Shrinks cells without extent, which cospherical samples cause, by steps that each keep the
// topology. An edge without length shrinks to a point, unless it closes a loop. A facet that is
// left with one edge shrinks to a point with it. A facet that is left with two edges shrinks to one
// edge, unless both are the same already. Steps that a facet takes to and fro do not count. A facet
// in one place is removed with an edge that no other facet has. So the cells around the axis of a
// tube, whose facets are segments, become a curve.
#pragma once

#include "collapse/complex.h"

namespace medial {

// Returns the shrunk complex; `place` gives for each vertex the lowest vertex in the same place.
InnerComplex shrink(InnerComplex complex, std::span<const int32_t> place, const Run& run);

}  // namespace medial
