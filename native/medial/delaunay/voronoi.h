// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the Voronoi vertices: one per Delaunay cell, or per cluster of cospherical cells.
#pragma once

#include "delaunay/triangulation.h"

namespace medial {

struct Voronoi {
  // This is the circumcentre of a finite cell. For an infinite cell it is the outward unit normal
  // of its hull triangle, which is the direction of the dual Voronoi ray.
  Array<Vec3> centre;
  // This is the lowest cell with the same Voronoi vertex (or Voronoi ray, for an infinite cell).
  // Two Voronoi vertices are the same if the arithmetic that computed them cannot distinguish them,
  // so the zero-length Voronoi edges between cospherical cells vanish.
  Array<int32_t> vertex;
};

// Returns the vector from a point to the Voronoi vertex of a cell, or the direction of the ray of
// an infinite cell.
inline Vec3 towards(const Vec3& point, const Triangulation& triangulation, const Voronoi& voronoi,
                    int32_t cell) {
  const Vec3& centre = voronoi.centre[cell];
  return triangulation.is_infinite(cell) ? centre : centre - point;
}

Voronoi voronoi(std::span<const Vec3> points, const Triangulation& triangulation, const Run& run);

}  // namespace medial
