// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the inner cells that the samples alone have cut off, in wedges beside sharp edges and at
// the rims of openings.
#pragma once

#include <future>

#include "inside/sides.h"

namespace medial {

// The cells of pockets, ascending. A pocket is a part of the inner cells that hang together through
// their triangles with two properties: none of its balls is larger than the hole between the
// samples at it (`spacing` is the radius of the hole round each sample), so that they cannot tell
// its shape; and from one of its Voronoi vertices a straight way of some width leads through the
// solid, where `winding` exceeds 1/2, to one of a larger part that shares a sample with it. So
// bodies of their own, however small, and those that touch in an edge, are none. The number is
// waited for where there are small parts.
std::vector<int32_t> pockets(std::span<const Vec3> points, std::span<const double> spacing,
                             const std::shared_future<WindingNumber>& winding,
                             const Triangulation& triangulation, const Voronoi& voronoi,
                             const CellSides& sides, const Run& run);

// Sides with those cells outside.
CellSides without(std::span<const int32_t> cells, CellSides sides);

}  // namespace medial
