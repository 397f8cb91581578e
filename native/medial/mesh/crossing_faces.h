// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the triangles that pass through each other.
#pragma once

#include <medial/types.h>

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace medial {

// Returns the pairs of triangles of which one has a side that passes through the inside of the
// other one, the lower triangle first, in ascending order. Decided exactly. Triangles that only
// touch, such as neighbours, and triangles in one plane do not pass through each other.
//
// It ends early, with what was found by then, when it has compared `most` pairs whose boxes meet;
// long thin triangles have very many.
std::vector<Edge> crossing_faces(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                 int64_t most);

}  // namespace medial
