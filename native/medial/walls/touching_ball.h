// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the ball that touches several walls, near a given place.
#pragma once

#include "walls/faces.h"

namespace medial {

// At most four walls determine a ball in space.
inline constexpr size_t kMostContacts = 4;
// Directions to walls that differ by less than about 5 degrees do not determine a place.
inline constexpr double kSameDirection = 0.08;

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
