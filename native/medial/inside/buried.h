// SPDX-License-Identifier: GPL-3.0-or-later
// Finds places where a closed surface is not the boundary of its solid.
#pragma once

#include "base/vec3.h"
#include "inside/surface.h"

namespace medial {

// Returns for each point whether the winding number is above 1/2 at both of point +- offset normal,
// or at neither of them. This happens where shells overlap, where there are walls inside, and on
// sheets without thickness. A zero normal gives 0. Throws InvalidInputError, also for triangles
// that are not closed, and Cancelled.
std::vector<uint8_t> buried(std::span<const Vec3> points, std::span<const Vec3> normals,
                            double offset, std::span<const Vec3> vertices,
                            std::span<const Triangle> triangles, const Run& run);

}  // namespace medial
