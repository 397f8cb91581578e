// SPDX-License-Identifier: GPL-3.0-or-later
// Places of a solid at which distances to balls are bounded, and even selections of points.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/nearest_ball.h"
#include "base/run.h"

namespace medial {

// Returns the distance of a place from a ball, negative in it.
inline double gap(const Ball& ball, const Vec3& place) {
  return distance(place, ball.centre) - ball.radius;
}

// A place from which balls are not to be far. Where all balls are, as on a part of a surface
// without any, a bound on the distance allows a share of itself more than the nearest one, so that
// such a place does not loosen the bound of all others.
struct BoundedPlace {
  Vec3 at;
  double least = 0;  // the distance from the nearest of all balls: no choice comes nearer

  static constexpr double kMore = 0.25;  // chosen: unseen

  double limit(double bound) const { return std::max(bound, least + kMore * bound); }
  // Returns the least bound that allows a distance.
  double bound(double away) const { return std::min(away, (away - least) / kMore); }
};

// Returns places with their distances from the nearest of some balls.
std::vector<BoundedPlace> bounded(std::span<const Vec3> places, std::span<const Ball> balls,
                                  const Run& run);

// Returns the centres of pieces of the triangles whose edges are at most `piece` long, one in each
// cubic cell of that size.
std::vector<Vec3> surface_places(std::span<const Vec3> vertices, std::span<const Triangle> faces,
                                 double piece, const Run& run);

// Returns ids, in rising order, of one point in each cubic cell: the one with the largest rank,
// ties by lowest id. Without ranks, the first.
std::vector<int32_t> one_per_cell(std::span<const Vec3> points, std::span<const double> ranks,
                                  double cell);

// Returns at most `most` points, one in each cell; the cells are as small as possible up to a
// factor, and no smaller than `cell`.
std::vector<Vec3> even_places(std::span<const Vec3> points, double cell, int64_t most);

}  // namespace medial
