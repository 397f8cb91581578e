// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds the distance from a point to a curved triangle, without looking for its nearest place.
#pragma once

#include "sampling/pn_triangles.h"

namespace medial {

// Returns a lower bound of the squared distance from a point to a cubic patch. It is close: the
// difference is of third order in the size of the patch.
double least_squared_distance(const Patch& patch, const Vec3& from);

}  // namespace medial
