// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how thick a solid is behind its surface.
#pragma once

#include <span>
#include <vector>

#include "base/run.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

// Returns the distance from each point of the boundary, against its outward unit normal, to the
// opposite wall: the place where the way leaves the solid through a triangle that faces away from
// the point, within 30 degrees. The distance is infinite if the way is longer than the point's
// reach, if it leaves at a slant, as next to a sharp edge, and for a zero normal. The way passes
// through other parts of the solid that it enters before.
std::vector<double> wall_distances(std::span<const Vec3> points, std::span<const Vec3> normals,
                                   std::span<const double> reach, std::span<const Vec3> vertices,
                                   std::span<const Triangle> triangles, const Run& run);

}  // namespace medial
