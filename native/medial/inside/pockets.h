// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the parts of the inner cells that only the sampling has cut off, in wedges beside sharp
// edges and at the rims of openings.
#pragma once

#include <future>

#include "inside/sides.h"

namespace medial {

// Returns the cells of pockets, ascending. A pocket is a part of the inner cells, connected through
// their triangles, with two properties. None of its balls is larger than the hole between the
// samples at it (`spacing` is the radius of the hole around each sample), so the samples cannot
// determine its shape. And a straight way of some width leads from one of its Voronoi vertices
// through the solid, where `winding` exceeds 1/2, to a Voronoi vertex of a larger part that shares
// a sample with it. So separate bodies, however small, and bodies that touch in an edge are not
// pockets. The function waits for `winding` only if there are small parts.
std::vector<int32_t> pockets(std::span<const Vec3> points, std::span<const double> spacing,
                             const std::shared_future<WindingNumber>& winding,
                             const Triangulation& triangulation, const Voronoi& voronoi,
                             const CellSides& sides, const Run& run);

// Returns the sides with those cells outside.
CellSides without(std::span<const int32_t> cells, CellSides sides);

}  // namespace medial
