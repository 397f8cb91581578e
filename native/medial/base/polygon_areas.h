// SPDX-License-Identifier: GPL-3.0-or-later
// This finds the areas and normals of polygons.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/vec3.h"

namespace medial {

// Returns a vector for each polygon along its normal, twice as long as its area is large. Polygons
// are as in polygon_edges. Throws InvalidInputError.
std::vector<Vec3> doubled_areas(std::span<const Vec3> points, std::span<const int32_t> face_offsets,
                                std::span<const int32_t> corners, const Run& run);

}  // namespace medial
