// SPDX-License-Identifier: GPL-3.0-or-later
// Computes Betti numbers by counting: components by union-find, cavities by Alexander duality as
// components of the samples outside, tunnels from the Euler characteristic.
#pragma once

#include <medial/hierarchy.h>

#include "collapse/complex.h"

namespace medial {

// Returns for each sample, and for one more that represents infinity, the lowest sample that it is
// connected with by Delaunay edges whose facets are not in the complex. The points of a bounding
// sphere count as infinity.
Array<int32_t> outside_components(const InnerComplex& complex, int32_t samples,
                                  const Triangulation& triangulation, const Edges& edges,
                                  const Run& run);

// Marks the cells of a complex that are left.
struct Alive {
  Array<uint8_t> facet, edge, vertex;
};

// Returns the Betti numbers of the cells that are left of the complex; no 3-cell may be left.
Betti betti_of(const InnerComplex& complex, std::span<const int32_t> outside, const Alive& alive,
               const Run& run);

// Does the same where the number of cavities is known, which no collapse changes.
Betti betti_of(const InnerComplex& complex, int64_t cavities, const Alive& alive, const Run& run);

// Returns the Betti numbers of the complex itself.
Betti betti_of(const InnerComplex& complex, std::span<const int32_t> outside, const Run& run);

}  // namespace medial
