// Inside and outside: a side per Delaunay cell (where its Voronoi vertex lies), and from it a side
// per facet.
#pragma once

#include "surface.h"
#include "voronoi.h"

namespace medial {

// Which axis a facet belongs to. As an argument `both` selects every facet, as a value it means
// "not known".
enum class Side : int32_t { both = 0, inner = 1, outer = 2, crossing = 3 };

// Side of each cell: inner or outer. Infinite cells are outer. Empty: not known.
using CellSides = std::vector<uint8_t>;

// Inner exactly where the winding number of the surface at the Voronoi vertex exceeds 1/2.
CellSides sides_from_surface(std::span<const Vec3> points, const Surface& surface,
                             const Triangulation& triangulation, const Voronoi& voronoi,
                             const Run& run);

// inner: every cell of the ring is; outer: none is; crossing: some are; both: not known.
Side facet_side(std::span<const int32_t> ring, const CellSides& sides);

}  // namespace medial
