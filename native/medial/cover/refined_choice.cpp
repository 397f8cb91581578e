// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/refined_choice.h"

#include <cmath>

#include "base/parallel.h"
#include "base/rows.h"
#include "cover/ball_bound.h"
#include "cover/ball_exchange.h"
#include "cover/ball_places.h"

namespace medial {
namespace {

// Bounds are searched at this many places, or this many for each ball.
constexpr double kFine = 0.5;  // steps of the lattice: searches for bounds end; chosen: unseen
constexpr int64_t kPlaces = 32768, kPlacesOfBall = 40;

std::vector<Vec3> centres_of(std::span<const Ball> balls) {
  std::vector<Vec3> centres;
  for (const Ball& ball : balls) centres.push_back(ball.centre);
  return centres;
}

std::vector<double> radii_of(std::span<const Ball> balls) {
  std::vector<double> radii;
  for (const Ball& ball : balls) radii.push_back(ball.radius);
  return radii;
}

// Returns the largest ball in each cell of the lattice.
std::vector<int32_t> distinct_balls(std::span<const Ball> balls, double cell) {
  auto ids = one_per_cell(centres_of(balls), radii_of(balls), cell);
  std::erase_if(ids, [&](int32_t id) { return !(balls[id].radius > 0); });
  return ids;
}

// Returns the least bound within which balls serve all places.
double bound_of(std::span<const BoundedPlace> places, std::span<const Ball> balls, const Run& run) {
  const NearestBall nearest(balls);
  std::vector<double> bounds(places.size());
  parallel_for(static_cast<int64_t>(places.size()), {run.threads}, [&](int64_t i) {
    const Vec3& at = places[i].at;
    bounds[i] = places[i].bound(gap(balls[nearest.find(at)], at));
  });
  return bounds.empty() ? 0 : *std::max_element(bounds.begin(), bounds.end());
}

// Returns balls that follow the farthest place, and the bound within which they serve the places.
BoundedBalls farthest_first(std::span<const Ball> balls, int64_t count,
                            std::span<const BoundedPlace> places, const SolidLattice& whole,
                            const Run& run) {
  SolidLattice rest(whole);
  auto chosen = balls_by_distance(balls, count, rest, {run.threads}).chosen;
  const double bound = bound_of(places, rows_of(balls, chosen), run);
  return {bound, std::move(chosen)};
}

// Adds the balls that hold most of what the chosen ones leave, up to `count` in all.
void fill(std::vector<int32_t>& chosen, std::span<const Ball> balls, std::span<const int32_t> ids,
          int64_t count, const SolidLattice& whole, const Run& run) {
  SolidLattice rest(whole);
  for (const int32_t id : chosen) rest.remove(balls[id].centre, balls[id].radius);
  const auto some = rows_of(balls, ids);
  const int64_t more = count - static_cast<int64_t>(chosen.size());
  for (const int32_t row : balls_by_volume(some, more, rest, {run.threads}).chosen) {
    chosen.push_back(ids[row]);
  }
}

// Orders balls by the volume that each adds to those before it; those that add none come last.
BallChoice ordered(std::span<const int32_t> chosen, std::span<const Ball> balls, SolidLattice& left,
                   const Run& run) {
  const auto some = rows_of(balls, chosen);
  BallChoice result = balls_by_volume(some, static_cast<int64_t>(some.size()), left, {run.threads});
  std::vector<bool> seen(some.size(), false);
  for (int32_t& row : result.chosen) {
    seen[row] = true;
    row = chosen[row];
  }
  const double held = result.covered.empty() ? 0 : result.covered.back();
  for (size_t row = 0; row < some.size(); ++row) {
    if (seen[row]) continue;
    result.chosen.push_back(chosen[row]);
    result.covered.push_back(held);
  }
  return result;
}

}  // namespace

BallChoice balls_by_bound(std::span<const Ball> balls, int64_t count, double share,
                          std::span<const Vec3> places, SolidLattice& left, const Run& run) {
  const auto ids = distinct_balls(balls, left.step());
  if (ids.empty()) return {};
  const auto most = static_cast<int64_t>(std::ceil(share * static_cast<double>(count)));
  const auto some = rows_of(balls, ids);
  const auto even = bounded(
      even_places(places, left.step(), std::max(kPlaces, kPlacesOfBall * count)), some, run);
  auto first = farthest_first(balls, most, even, left, run);
  auto chosen =
      bounded_balls(balls, ids, even, most, kFine * left.step(), std::move(first), run).chosen;
  advance(run.progress, 0.3);
  fill(chosen, balls, ids, count, left, run);
  advance(run.progress, 0.4);
  const auto all = bounded(places, some, run);
  const double bound = bound_of(all, rows_of(balls, chosen), run);
  exchange_balls({balls, ids, all, bound}, chosen, left, run);
  advance(run.progress, 0.9);
  return ordered(chosen, balls, left, run);
}

}  // namespace medial
