// SPDX-License-Identifier: GPL-3.0-or-later
// This computes how large balls must be to hold a surface.
#pragma once

#include <span>
#include <vector>

#include "base/nearest_ball.h"
#include "base/run.h"

namespace medial {

// Returns the radii that the balls need. The surface is cut into pieces with edges of at most
// `piece`; each belongs to the ball nearest to its centre, as each place belongs to the ball
// nearest to it. A ball must hold all that belongs to it; its radius is 0 if that is nothing. So
// balls of these radii hold the surface and the places, and more balls need no larger radii.
std::vector<double> needed_radii(std::span<const Ball> balls, std::span<const Vec3> vertices,
                                 std::span<const Triangle> triangles, std::span<const Vec3> places,
                                 double piece, const Run& run);

}  // namespace medial
