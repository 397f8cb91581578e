// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the place of one curved patch that is closest to a point; for flat triangles see
// closest_on_flat.
#pragma once

#include "sampling/closest_on_flat.h"

namespace medial {

// Returns the place of a curved patch that is locally closest to a point, by Newton's method from
// `start`, which stays inside the triangle. A coordinate is exactly 0 on the opposite side.
Barycentric closest_on_patch(const Patch& patch, const Barycentric& start, const Vec3& x);

}  // namespace medial
