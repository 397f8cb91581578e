// SPDX-License-Identifier: GPL-3.0-or-later
// Where a closed surface is no boundary of its solid.
#pragma once

#include "base/vec3.h"
#include "inside/surface.h"

namespace medial {

// Whether the winding number is above 1/2 at both of point +- offset normal, or at neither, as
// where shells overlap, walls stand inside and sheets have no thickness. A zero normal tells
// nothing: no. Throws InvalidInputError, also for triangles that are not closed, and Cancelled.
std::vector<uint8_t> buried(std::span<const Vec3> points, std::span<const Vec3> normals,
                            double offset, std::span<const Vec3> vertices,
                            std::span<const Triangle> triangles, const Run& run);

}  // namespace medial
