// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the ball that touches several walls, near a given place.
#pragma once

#include "walls/faces.h"

namespace medial {

// At most four walls determine a ball in space.
inline constexpr size_t kMostContacts = 4;
// Directions to feet that differ by less (5 degrees) are those to one foot, and determine no place.
inline constexpr double kSameFoot = 0.08;  // chosen: axis

struct TouchingBall {
  Vec3 centre;
  double radius = 0;
  double unequal = HUGE_VAL;               // the largest difference of the distances to the walls
  std::array<Vec3, kMostContacts> away{};  // the unit directions from the feet to the centre
};

// Moves a centre by the shortest way to where it is equally far from some walls, each named by a
// triangle of it, which moves along to the feet. Walls that are touched in the same direction count
// as one.
TouchingBall touching_ball(const Faces& faces, std::span<int32_t> walls, const Vec3& start);

}  // namespace medial
