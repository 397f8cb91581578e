// SPDX-License-Identifier: GPL-3.0-or-later
// A solid as few balls, chosen among those of its medial axis: for collisions, physics, robots.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <span>

namespace medial {

//   inside  no ball reaches out of the solid; what they leave uncovered is stated.
//   around  the balls hold all of the surface, and all places of the lattice in the solid; how far
//           they reach out of it is stated.
enum class CoverMode : int32_t { inside = 0, around = 1 };

// Candidates, and the solid that they are to cover.
struct BallCoverInput {
  std::span<const Vec3> centres;    // of the balls to choose from, such as those of an inner axis
  std::span<const double> radii;    // one for each
  std::span<const Vec3> vertices;   // of the surface of the solid
  std::span<const Triangle> faces;  // outward, rows of `vertices`
};

// How many balls, and where they may be.
struct BallCoverOptions {
  int64_t count = 64;  // of balls, at most
  CoverMode mode = CoverMode::inside;
  int64_t places = 100'000;  // of the lattice in the solid, at least half as many where it may
};

// Volumes are numbers of places of a cubic lattice in the solid, which is where the winding number
// of its faces exceeds 1/2. Inside, each ball is the one that holds most of what those before it
// left, so the first n hold at least 1 - 1/e of the places that any n of the candidates hold.
// Around, it is one that comes near to the place farthest from those before it.
struct BallCover {
  // In the order in which they were chosen, which does not depend on their number. Fewer than
  // asked for: more of the candidates would not add anything.
  std::vector<int32_t> chosen;  // (n) rows of the candidates
  std::vector<double> radii;    // (n) inside: no longer than to the surface; around: grown
  // (n) share of the places that the first 1, 2, ... n balls hold, before they grow.
  std::vector<double> covered;
  double outside = 0;   // no place in a ball is farther from the solid
  double farthest = 0;  // no place on the surface is farther from the balls
  int64_t places = 0;
  double step = 0;  // of the lattice
};

// `threads` 0: all cores; the result does not depend on it. Throws InvalidInputError,
// DegenerateInputError where the faces enclose no place or none of the candidates holds one,
// Cancelled.
BallCover cover_by_balls(const BallCoverInput& input, const BallCoverOptions& options = {},
                         int threads = 0, Progress* progress = nullptr);

}  // namespace medial
