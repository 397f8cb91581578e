// SPDX-License-Identifier: GPL-3.0-or-later
// The largest capsule round a segment that stays in a solid, how far one leaves it, and lines below
// and above lengths that change along a segment.
#pragma once

#include <vector>

#include "cover/covered_solid.h"

namespace medial {

// A length at a share of a segment, 0 at its first end and 1 at its second.
struct LengthAt {
  double share = 0, length = 0;
};

// A linear length, by its values at both ends.
struct LinearLength {
  double first = 0, second = 0;

  double at(double share) const { return (1 - share) * first + share * second; }
};

// Returns, of the lines that are nowhere above a point, the one that is highest in the middle.
// There must be points at shares of at most and of at least 1/2.
LinearLength highest_below(const std::vector<LengthAt>& points);

// Returns, of the lines that are nowhere below a point, the one that is lowest in the middle.
LinearLength lowest_above(std::vector<LengthAt> points);

// The searches end so close to the truth, as a share of the larger radius: radii in a solid are as
// exact.
inline constexpr double kOfRadius = 1.0 / 256;  // chosen: unseen

// The union of the balls round the places of a segment. With equal ends it is a ball.
struct Capsule {
  Vec3 a, b;
  LinearLength radius;

  Vec3 place(double share) const { return (1 - share) * a + share * b; }
  double volume() const;
};

// Returns an upper bound, close to the least one, of how far the balls of a capsule reach out of
// the solid: of radius less depth. It is negative if the capsule could grow by this much. Balls
// between the places that are looked at are bounded, because depths change no faster than places.
double reach_out(const Capsule& capsule, const SolidDepth& depth);

// Returns the largest of some capsules in the solid: those round the whole segment, with equal
// radii and, if `tapered`, with the radii that are largest in the middle; and the balls round the
// ends. Radii are 0 if both ends are outside.
Capsule inner_capsule(const Vec3& a, const Vec3& b, bool tapered, const SolidDepth& depth);

}  // namespace medial
