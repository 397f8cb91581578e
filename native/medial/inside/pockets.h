// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the parts of the inner cells that are too small for the samples to determine their shape:
// pockets, which only the sampling has cut off, in wedges next to sharp edges and at the rims of
// openings; and crumbs, which may be small bodies.
#pragma once

#include <future>
#include <optional>

#include "inside/sides.h"

namespace medial {

struct SmallParts {
  std::vector<int32_t> pockets;              // the cells of all pockets, ascending
  std::vector<std::vector<int32_t>> crumbs;  // the cells of each crumb; crumbs with few cells first
};

// Returns the small parts of the inner cells. A part is connected through the triangles between its
// cells; it is small if none of its balls is larger than the hole between the samples at it
// (`spacing` is the radius of the hole around each sample), so the samples cannot determine its
// shape. It is a pocket if a straight way of some width leads from one of its Voronoi vertices
// through the solid, where `winding` exceeds 1/2, to a Voronoi vertex of a larger part that shares
// a sample with it. So separate bodies, however small, and bodies that touch in an edge are not
// pockets. All other small parts are crumbs. The function waits for `winding` only if there are
// small parts.
SmallParts small_parts(std::span<const Vec3> points, std::span<const double> spacing,
                       const std::shared_future<WindingNumber>& winding,
                       const Triangulation& triangulation, const Voronoi& voronoi,
                       const CellSides& sides, const Run& run);

// Returns the sides with the cells of pockets outside and, if the number of bodies is known, those
// of crumbs, too, as long as more parts than bodies are left. All parts stay if all are crumbs.
CellSides without(const SmallParts& small, std::optional<int64_t> bodies,
                  const Triangulation& triangulation, CellSides sides);

}  // namespace medial
