// SPDX-License-Identifier: GPL-3.0-or-later
// A solid is approximated by few balls, chosen among those of its medial axis: for collisions,
// physics, robots.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <span>

namespace medial {

//   inside  no ball reaches out of the solid; what they leave uncovered is stated.
//   around  the balls hold all of the surface, and all places of the lattice in the solid; how far
//           they reach out of it is stated.
enum class CoverMode : int32_t { inside = 0, around = 1 };

// The input is the candidates, and the solid that they are to cover.
struct BallCoverInput {
  std::span<const Vec3> centres;    // of the balls to choose from, such as those of an inner axis
  std::span<const double> radii;    // one for each
  std::span<const Vec3> vertices;   // of the surface of the solid
  std::span<const Triangle> faces;  // outward, rows of `vertices`
};

// These options choose the number of balls, and where they may be.
struct BallCoverOptions {
  int64_t count = 64;  // most balls to choose
  CoverMode mode = CoverMode::inside;
  int64_t places = 100'000;  // of the lattice in the solid, at least half as many where it may
  // The choice bounds the distance of the surface first, then exchanges balls for those that hold
  // more. Without, or with more than 1024 balls, it is greedy, and the first of many are the few.
  bool refine = true;
  // With `inside`, balls that leave something out may grow until they reach out so far.
  double tolerance = 0;
};

// Volumes are counted in places of a cubic lattice in the solid, where the winding number of its
// faces exceeds 1/2. With `inside`, each ball is the one that holds most of the places left by
// those before it, so the first n hold at least 1 - 1/e of the places that any n of the candidates
// hold. With `around`, each ball comes near to the place farthest from those before it.
struct BallCover {
  // The balls are in the order of choice, which does not depend on their number. There are fewer
  // than requested if more of the candidates would not add anything.
  std::vector<int32_t> chosen;  // (n) rows of the candidates
  std::vector<double> radii;    // (n) inside: no longer than to the surface; around: grown
  // This is the (n) share of the places that the first 1, 2, ... n balls hold, before they grow.
  std::vector<double> covered;
  double held = 0;      // share of the places that all balls hold, after they grew
  double outside = 0;   // no place in a ball is farther from the solid
  double farthest = 0;  // no place on the surface is farther from the balls
  int64_t places = 0;
  double step = 0;  // spacing of the lattice
};

// Chooses the balls. `threads` 0 means all cores; the result does not depend on it. Throws
// InvalidInputError, DegenerateInputError if the faces enclose no place or none of the candidates
// holds one, Cancelled.
BallCover cover_by_balls(const BallCoverInput& input, const BallCoverOptions& options = {},
                         int threads = 0, Progress* progress = nullptr);

}  // namespace medial
