// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the place of a flat triangle that is closest to a point.
#pragma once

#include "sampling/pn_triangles.h"

namespace medial {

// Returns the place of a flat triangle that is closest to a point. A coordinate is exactly 0 if the
// place is on the opposite side.
Barycentric closest_on_flat(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& x);

}  // namespace medial
