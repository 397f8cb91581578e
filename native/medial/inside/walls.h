// SPDX-License-Identifier: GPL-3.0-or-later
// How thick a solid is behind its surface.
#pragma once

#include <span>
#include <vector>

#include "base/run.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

// The distance from each point of the boundary, against its outward unit normal, to the opposite
// wall: the place where the way leaves the solid through a triangle that is turned away from the
// point, within 30 degrees. Infinite where the way is longer than the point's reach, where it
// leaves at a slant, as beside a sharp edge, and for a zero normal. Other parts of the solid that
// the way enters before are passed through.
std::vector<double> wall_distances(std::span<const Vec3> points, std::span<const Vec3> normals,
                                   std::span<const double> reach, std::span<const Vec3> vertices,
                                   std::span<const Triangle> triangles, const Run& run);

}  // namespace medial
