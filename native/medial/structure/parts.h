// SPDX-License-Identifier: GPL-3.0-or-later
// A part of an axis is a sheet: connected facets with the same label, the pair of patches between
// which they lie.
#pragma once

#include "structure/facets.h"

namespace medial {

struct AxisParts {
  std::vector<int32_t> of_facet;  // (f)
  std::vector<uint8_t> crumb;     // (f) whether its own sheet was too small, and given away
  std::vector<Edge> label;        // (p) lower patch first

  int32_t count() const { return static_cast<int32_t>(label.size()); }
};

// Finds the parts, in the order that Structure describes.
AxisParts parts_of(const Facets& facets, const Run& run);

}  // namespace medial
