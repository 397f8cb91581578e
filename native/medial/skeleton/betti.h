// SPDX-License-Identifier: GPL-3.0-or-later
// Betti numbers, counted on what is there: components by union-find, cavities by Alexander duality
// as components of the samples outside, tunnels from the Euler characteristic.
#pragma once

#include <medial/hierarchy.h>

#include "skeleton/complex.h"

namespace medial {

// Per sample, and one more for infinity: the lowest of those it is joined with by Delaunay edges
// whose facets are not in the complex. The points of a bounding sphere count as infinity.
Array<int32_t> outside_components(const InnerComplex& complex, int32_t samples,
                                  const Triangulation& triangulation, const Edges& edges,
                                  const Run& run);

// Which cells of a complex are there.
struct Alive {
  Array<uint8_t> facet, edge, vertex;
};

// The Betti numbers of the cells that are left of the complex, none of which is a 3-cell.
Betti betti_of(const InnerComplex& complex, std::span<const int32_t> outside, const Alive& alive,
               const Run& run);

// The Betti numbers of the complex itself.
Betti betti_of(const InnerComplex& complex, std::span<const int32_t> outside, const Run& run);

}  // namespace medial
