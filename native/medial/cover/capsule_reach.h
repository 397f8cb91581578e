// SPDX-License-Identifier: GPL-3.0-or-later
// How large capsules must be to hold a surface, and what they hold.
#pragma once

#include <span>
#include <vector>

#include "cover/capsule_fit.h"
#include "reduce/envelope.h"

namespace medial {

// The capsules as a sphere mesh: the spheres 2k and 2k + 1 are the ends of capsule k.
SphereMesh sphere_mesh_of(std::span<const Capsule> capsules);

// Returns, for each capsule, how much larger it must be to hold what is nearest to it: lengths at
// shares of its segment, negative where it could be smaller. The surface is cut into pieces with
// edges of at most `piece`; each belongs to the capsule nearest to its centre, as each place
// belongs to the capsule nearest to it. Capsules are convex, so one that holds the corners holds
// the piece.
std::vector<std::vector<LengthAt>> needed_growth(std::span<const Capsule> capsules,
                                                 const CoveredSolid& solid,
                                                 std::span<const Vec3> places, double piece,
                                                 const Run& run);

// Returns a bound of how far the surface is from the capsules.
double farthest_from(std::span<const Capsule> capsules, const CoveredSolid& solid, double piece,
                     const Run& run);

// Returns how many of the places the capsules hold.
int64_t held_places(std::span<const Capsule> capsules, std::span<const Vec3> places,
                    const Run& run);

}  // namespace medial
