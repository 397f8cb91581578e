// SPDX-License-Identifier: GPL-3.0-or-later
// Wraps faces that bound nothing in a closed surface.
#pragma once

#include <span>
#include <vector>

#include "base/run.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

struct Wrapping {
  std::vector<Vec3> rows;
  std::vector<Triangle> triangles;  // closed, without self-intersections, outward
};

// Returns a surface round faces, as if a ball as wide as the openings rolled over them and stopped
// at a distance (alpha wrapping of Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner & Alliez 2022, by
// CGAL). Both lengths are shares of the diagonal of the rows' bounding box. Throws
// InvalidInputError where there is no face with an area, or CGAL is older than 5.5.
Wrapping wrap(std::span<const Vec3> rows, std::span<const Triangle> triangles, double opening,
              double distance, const Run& run);

}  // namespace medial
