// SPDX-License-Identifier: GPL-3.0-or-later
// The topology of the solid that a closed surface bounds, as the surface alone tells it.
#pragma once

#include <array>
#include <optional>

#include "base/vec3.h"
#include "inside/surface.h"

namespace medial {

// Pieces, loops and cavities of the solid whose boundary the surface is, if it passes nowhere
// through itself: shells that point outward are pieces, those that point inward cavities, and every
// handle is a loop. Nothing for a surface that is no closed manifold, or has a shell without
// volume.
std::optional<std::array<int64_t, 3>> solid_betti(const Surface& surface,
                                                  std::span<const Vec3> points, const Run& run);

}  // namespace medial
