// SPDX-License-Identifier: GPL-3.0-or-later
// Inside and outside: a side per Delaunay cell (where its Voronoi vertex lies), and from it a side
// per facet.
#pragma once

#include <medial/options.h>

#include "delaunay/voronoi.h"
#include "inside/surface.h"
#include "inside/winding_number.h"

namespace medial {

// Side of each cell: inner or outer. Infinite cells are outer. Empty: not known.
using CellSides = std::vector<Side>;

// Inner exactly where the winding number of the surface at the Voronoi vertex exceeds 1/2.
// `vertices` are those of the surface: the points themselves, or others. `winding` is its number.
CellSides sides_from_surface(std::span<const Vec3> points, std::span<const Vec3> vertices,
                             const Surface& surface, const WindingNumber& winding,
                             const Triangulation& triangulation, const Voronoi& voronoi,
                             const Run& run);

// A vote of the corners of each cell: inner where their outward normals point away from its Voronoi
// vertex, by the sum of the cosines. `normals` are per sample, unit or zero; zero ones do not vote.
CellSides sides_from_normals(std::span<const Vec3> points, std::span<const Vec3> normals,
                             const Triangulation& triangulation, const Voronoi& voronoi,
                             const Run& run);

// Inner where the cell is part of the solid and its Voronoi vertex lies in the solid as well: a
// flat cell beneath the surface may have its Voronoi vertex far outside. `boundary` holds the
// triangles between the solid and the rest.
CellSides sides_in_solid(std::span<const Vec3> points, const CellSides& solid,
                         std::span<const Triangle> boundary, const Triangulation& triangulation,
                         const Voronoi& voronoi, const Run& run);

// Whether a facet may be inner, or outer, as far as one cell of its ring tells.
inline bool may_be(Side side, int32_t cell, const CellSides& sides) {
  return (sides[cell] == Side::inner) == (side == Side::inner);
}

// inner: every cell of the ring is; outer: none is; crossing: some are; both: not known.
Side facet_side(std::span<const int32_t> ring, const CellSides& sides);

}  // namespace medial
