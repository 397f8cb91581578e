// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the place of one triangle, flat or curved, that is closest to a point.
#pragma once

#include "sampling/pn_triangles.h"

namespace medial {

// Returns the place of a flat triangle that is closest to a point. A coordinate is exactly 0 if the
// place is on the opposite side.
Barycentric closest_on_flat(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& x);

// Returns the place of a curved patch that is locally closest to a point, by Newton's method from
// `start`, which stays inside the triangle. A coordinate is exactly 0 on the opposite side.
Barycentric closest_on_patch(const Patch& patch, const Barycentric& start, const Vec3& x);

}  // namespace medial
