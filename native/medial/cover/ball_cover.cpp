// SPDX-License-Identifier: GPL-3.0-or-later
#include <medial/ball_cover.h>

#include <string>

#include "base/parallel.h"
#include "base/rows.h"
#include "base/text.h"
#include "cover/ball_choice.h"
#include "cover/ball_places.h"
#include "cover/ball_reach.h"
#include "cover/covered_solid.h"
#include "cover/refined_choice.h"

namespace medial {
namespace {

constexpr int64_t kBallsOfTask = 256;  // balls in one piece of work
// With more balls than this, a refined choice would cost much and gain next to nothing.
constexpr int64_t kMostRefined = 1024;
// This share of the balls inside bounds how far the surface is from them.
constexpr double kBounding = 0.9;  // chosen: unseen
// The places inside at which distances are bounded, too, are this many steps of the lattice apart.
constexpr double kCoarse = 2;  // chosen: unseen

void check(const BallCoverInput& input, const BallCoverOptions& options) {
  require_finite(input.centres, "centre");
  require_finite(input.vertices, "vertex");
  require_corners(input.faces, input.vertices.size());
  require_one_each(input.radii.size(), input.centres.size(), "one radius per centre",
                   "centres; pass all of them");
  for (const double radius : input.radii) {
    if (radius >= 0 && radius <= kLargestCoordinate) continue;
    throw InvalidInputError("Expected finite radii of 0 or more, found " + text(radius) +
                            "; correct it.");
  }
  require_amounts(options.count, options.places, options.tolerance, "ball");
}

// Returns the distance from each centre to the surface, negative outside.
std::vector<double> depths(std::span<const Vec3> centres, const CoveredSolid& solid,
                           const Run& run) {
  const SolidDepth depth(solid);
  std::vector<double> result(centres.size());
  parallel_for(
      static_cast<int64_t>(centres.size()), run,
      [&](int64_t i) { result[i] = depth.at(centres[i]); }, kBallsOfTask);
  return result;
}

// Shrinks the balls so that they stay in the solid; those around a centre outside get radius 0.
std::vector<Ball> inner_balls(const BallCoverInput& input, const CoveredSolid& solid,
                              std::span<const double> depth) {
  std::vector<Ball> balls;
  balls.reserve(depth.size());
  for (size_t i = 0; i < depth.size(); ++i) {
    const double radius = solid.frame.inward(input.radii[i]);
    balls.push_back(
        {solid.frame.inward(input.centres[i]), std::clamp(radius, 0.0, std::max(depth[i], 0.0))});
  }
  return balls;
}

// Returns the places from which balls are not to be far: on the surface, and if they are to hold
// the solid, inside it.
std::vector<Vec3> bounded_places(const CoveredSolid& solid, const SolidLattice& whole, bool around,
                                 const Run& run) {
  const double step = whole.step();
  auto places = surface_places(solid.vertices.points, solid.surface.triangles, step, run);
  if (!around) return places;
  const auto all = whole.places();
  for (const int32_t id : one_per_cell(all, {}, kCoarse * step)) places.push_back(all[id]);
  return places;
}

BallChoice choice(std::span<const Ball> balls, const BallCoverOptions& options,
                  const CoveredSolid& solid, SolidLattice& left, const Run& run) {
  const bool around = options.mode == CoverMode::around;
  if (options.refine && options.count <= kMostRefined) {
    const auto places = bounded_places(solid, left, around, run);
    return balls_by_bound(balls, options.count, around ? 1 : kBounding, places, left, run);
  }
  return (around ? balls_by_distance : balls_by_volume)(balls, options.count, left, run);
}

// Sets the radii of the chosen balls, which grow by at most `reach` to hold what is nearest to
// each, then how far the balls reach out of the solid, and how far the surface is from them.
void set_reach(BallCover& cover, std::span<const Ball> balls, std::span<const double> depth,
               double reach, const CoveredSolid& solid, SolidLattice& left, const Run& run) {
  const std::vector<Ball> kept = rows_of(balls, cover.chosen);
  const auto places = reach > 0 ? left.places() : std::vector<Vec3>{};
  const auto needed = needed_radii(kept, solid.vertices.points, solid.surface.triangles, places,
                                   kPiece * left.step(), run);
  for (size_t i = 0; i < kept.size(); ++i) {
    const double most = std::max(kept[i].radius, depth[cover.chosen[i]] + reach);
    const double radius = reach > 0 ? std::clamp(needed[i], kept[i].radius, most) : kept[i].radius;
    cover.farthest = std::max(cover.farthest, needed[i] - radius);
    cover.outside = std::max(cover.outside, radius - depth[cover.chosen[i]]);
    cover.radii.push_back(solid.frame.outward(radius));
    if (reach > 0) left.remove(kept[i].centre, radius);
  }
  const auto rest = static_cast<double>(left.places().size());
  cover.held = 1 - rest / static_cast<double>(left.count());
  cover.farthest = solid.frame.outward(cover.farthest);
  cover.outside = solid.frame.outward(cover.outside);
}

}  // namespace

BallCover cover_by_balls(const BallCoverInput& input, const BallCoverOptions& options, int threads,
                         Progress* progress) {
  const Run run{thread_count(threads), progress};
  begin_stage(run.progress, "Lattice", 0, 0.3);
  check(input, options);
  const CoveredSolid solid(input.vertices, input.faces, input.centres, run);
  SolidLattice left = solid.lattice(options.places, run);
  begin_stage(run.progress, "Depths of balls", 0.3, 0.5);
  const auto depth = depths(solid.frame.inward(input.centres), solid, run);
  const auto balls = inner_balls(input, solid, depth);
  begin_stage(run.progress, "Choice of balls", 0.5, 0.8);
  BallCover cover;
  auto [chosen, covered] = choice(balls, options, solid, left, run);
  cover.chosen = std::move(chosen);
  cover.covered = std::move(covered);
  if (cover.chosen.empty() || cover.covered.front() == 0) {
    throw DegenerateInputError("Expected balls in the solid, found none of " +
                               std::to_string(balls.size()) +
                               " that holds a place of the lattice; pass those of its inner axis.");
  }
  cover.places = left.count();
  cover.step = solid.frame.outward(left.step());

  begin_stage(run.progress, "Reach of balls", 0.8, 1);
  const double reach =
      options.mode == CoverMode::around ? HUGE_VAL : solid.frame.inward(options.tolerance);
  set_reach(cover, balls, depth, reach, solid, left, run);
  advance(run.progress, 1);
  return cover;
}

}  // namespace medial
