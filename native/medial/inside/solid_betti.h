// SPDX-License-Identifier: GPL-3.0-or-later
// Determines the topology of the solid that a closed surface bounds from the surface alone.
#pragma once

#include <array>
#include <optional>

#include "base/vec3.h"
#include "inside/surface.h"

namespace medial {

// Returns the numbers of pieces, loops and cavities of the solid that the surface bounds, if it
// does not intersect itself: shells that point outward are pieces, those that point inward are
// cavities, and every handle is a loop. Returns nothing for a surface that is not a closed
// manifold, or has a shell without volume.
std::optional<std::array<int64_t, 3>> solid_betti(const Surface& surface,
                                                  std::span<const Vec3> points, const Run& run);

}  // namespace medial
