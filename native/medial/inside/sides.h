// SPDX-License-Identifier: GPL-3.0-or-later
// Assigns a side, inside or outside, to each Delaunay cell (that of its Voronoi vertex), and from
// these to each facet.
#pragma once

#include <medial/options.h>

#include "delaunay/voronoi.h"
#include "inside/surface.h"
#include "inside/winding_number.h"

namespace medial {

// Holds the side of each cell: inner or outer. Infinite cells are outer. An empty list means
// unknown.
using CellSides = std::vector<Side>;

// Returns inner exactly where the winding number of the surface at the Voronoi vertex exceeds 1/2.
// `vertices` are those of the surface, which may be the points; `winding` is its winding number.
CellSides sides_from_surface(std::span<const Vec3> points, std::span<const Vec3> vertices,
                             const Surface& surface, const WindingNumber& winding,
                             const Triangulation& triangulation, const Voronoi& voronoi,
                             const Run& run);

// Lets the corners of each cell vote: it is inner if their outward normals point away from its
// Voronoi vertex, by the sum of the cosines. `normals` are per sample, unit or zero; zero ones do
// not vote.
CellSides sides_from_normals(std::span<const Vec3> points, std::span<const Vec3> normals,
                             const Triangulation& triangulation, const Voronoi& voronoi,
                             const Run& run);

// Returns inner where the cell is part of the solid and its Voronoi vertex is in the solid as well:
// a flat cell beneath the surface may have its Voronoi vertex far outside. `boundary` holds the
// triangles between the solid and the rest.
CellSides sides_in_solid(std::span<const Vec3> points, const CellSides& solid,
                         std::span<const Triangle> boundary, const Triangulation& triangulation,
                         const Voronoi& voronoi, const Run& run);

// Returns whether a facet may be inner, or outer, judged by one cell of its ring.
inline bool may_be(Side side, int32_t cell, const CellSides& sides) {
  return (sides[cell] == Side::inner) == (side == Side::inner);
}

// Returns inner if every cell of the ring is inner, outer if none is, crossing if some are, and
// both if the sides are unknown.
Side facet_side(std::span<const int32_t> ring, const CellSides& sides);

}  // namespace medial
