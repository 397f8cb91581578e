// SPDX-License-Identifier: GPL-3.0-or-later
// The facets of a sheet turn the same way, so that it looks smooth and can be given a thickness.
#pragma once

#include "structure/parts.h"

namespace medial {

// Returns for each facet whether it must be turned to agree with its sheet. A sheet between two
// patches is seen from the higher one; the largest coordinate of the normals of others is positive.
Column<uint8_t> turned_facets(const Facets& facets, const AxisParts& parts);

}  // namespace medial
