// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi vertices: one per Delaunay cell, or per cluster of cospherical cells.
#pragma once

#include "delaunay/triangulation.h"

namespace medial {

struct Voronoi {
  // Finite cell: its circumcentre. Infinite cell: the outward unit normal of its hull triangle,
  // which is the direction of the dual Voronoi ray.
  Array<Vec3> centre;
  // Lowest cell with the same Voronoi vertex (infinite cell: the same Voronoi ray). Cells are the
  // same when their centres cannot be told apart in the arithmetic that computed them, so that the
  // zero-length Voronoi edges between cospherical cells vanish.
  Array<int32_t> vertex;
};

// From a point to the Voronoi vertex of a cell; for an infinite cell the direction of its ray.
inline Vec3 towards(const Vec3& point, const Triangulation& triangulation, const Voronoi& voronoi,
                    int32_t cell) {
  const Vec3& centre = voronoi.centre[cell];
  return triangulation.is_infinite(cell) ? centre : centre - point;
}

Voronoi voronoi(std::span<const Vec3> points, const Triangulation& triangulation, const Run& run);

}  // namespace medial
