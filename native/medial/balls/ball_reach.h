// SPDX-License-Identifier: GPL-3.0-or-later
// How large balls have to be to hold a surface.
#pragma once

#include <span>
#include <vector>

#include "base/nearest_ball.h"
#include "base/run.h"

namespace medial {

// Radii that some of the balls need. The surface is cut into pieces with edges of at most `piece`;
// each belongs to the ball that is nearest to its centre, as each of the places belongs to the
// ball nearest to it. What a ball needs holds all that belongs to it; 0 where that is nothing. So
// balls of these radii hold the surface and the places, and more balls need no larger radii.
std::vector<double> needed_radii(std::span<const Ball> balls, std::span<const Vec3> vertices,
                                 std::span<const Triangle> triangles, std::span<const Vec3> places,
                                 double piece, const Run& run);

}  // namespace medial
