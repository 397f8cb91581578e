// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/held_ball.h"

namespace medial {
namespace {

constexpr int kSteps = 24;        // work: walls of a section
constexpr double kAsNear = 1e-6;  // of the radius; derived: rounding, 1e5 sizes away

// Returns the shortest vector in the convex hull of vectors in a plane, or none if 0 is in it.
Vec3 shortest_of_hull(std::span<const Vec3> all) {
  Vec3 best = all[0];
  for (const Vec3& one : all) {
    for (const Vec3& other : all) {
      const Vec3 way = other - one;
      const double square = squared_length(way);
      const double share = square > 0 ? std::clamp(-dot(one, way) / square, 0.0, 1.0) : 0;
      const Vec3 there = one + share * way;
      if (squared_length(there) < squared_length(best)) best = there;
    }
  }
  const double least = (1 - kAsNear) * squared_length(best) - kAsNear;
  const bool holds =
      std::any_of(all.begin(), all.end(), [&](const Vec3& one) { return dot(one, best) < least; });
  return holds ? Vec3{} : best;
}

class Climb {
 public:
  Climb(const SamplesOnFaces& samples, const Vec3& start, const Vec3& along)
      : samples_(samples), faces_(samples.faces()), start_(start), along_(along), centre_(start) {}

  Touch climb() {
    const auto first = nearest(start_, HUGE_VAL);
    if (!first || !is_inside(*first) || is_curved(*first)) return {};
    const Touch stays{.position = start_, .radius = first->distance};
    add(first->triangle);
    for (int i = 0; i < kSteps; ++i) {
      find_touched();
      const Vec3 way = shortest_of_hull(touched_);
      if (!(squared_length(way) > kSameFoot * kSameFoot)) return held(stays);
      if (!step(way)) break;
    }
    return stays;
  }

 private:
  std::optional<Foot> nearest(const Vec3& place, double than) const {
    return faces_.nearest_lifted({.from = place, .than = than},
                                 [&](const Foot& foot) { return !samples_.are_near(foot.point); });
  }

  bool is_curved(const Foot& foot) const {
    return faces_.bulge(foot.triangle) > kAsNear * foot.distance;
  }

  bool is_inside(const Foot& foot) const {
    return dot(start_ - foot.point, faces_.mesh().normal[foot.triangle]) < 0;
  }

  Vec3 slope(const Foot& foot) const {
    const Vec3 away = normalized(centre_ - foot.point);
    return away - dot(away, along_) * along_;
  }

  void add(int32_t wall) {
    walls_.push_back(wall);
    feet_.push_back(faces_.descend(wall, centre_));
  }

  void find_touched() {
    touched_.clear();
    radius_ = least(feet_);
    for (const Foot& foot : feet_) {
      if (touches(foot)) touched_.push_back(slope(foot));
    }
  }

  bool touches(const Foot& foot) const { return foot.distance <= (1 + kAsNear) * radius_; }

  static double least(std::span<const Foot> feet) {
    double least = HUGE_VAL;
    for (const Foot& foot : feet) least = std::min(least, foot.distance);
    return least;
  }

  // Goes on until another known wall is as near as those that are touched. If a wall that was not
  // known is nearer there, the centre stays. Returns false where no wall ends the way near by.
  bool step(const Vec3& way) {
    const double growth = squared_length(way);
    double reach = radius_ / std::sqrt(growth);
    for (const Foot& foot : feet_) {
      const double falls = growth - dot(slope(foot), way);
      if (!touches(foot) && falls > 0) reach = std::min(reach, (foot.distance - radius_) / falls);
    }
    const Vec3 next = centre_ + reach * way;
    std::vector<Foot> there;
    for (const int32_t wall : walls_) there.push_back(faces_.descend(wall, next));
    const double known = least(there);
    if (const auto nearer = nearest(next, (1 - kAsNear) * known)) {
      if (std::find(walls_.begin(), walls_.end(), nearer->triangle) != walls_.end()) return false;
      add(nearer->triangle);
      return true;
    }
    centre_ = next;
    feet_ = std::move(there);
    return known > radius_ && distance(centre_, start_) < known;
  }

  Touch held(const Touch& stays) const {
    for (const Foot& foot : feet_) {
      if (!touches(foot)) continue;
      if (is_curved(foot)) return {};
      if (!samples_.are_near(foot.point)) return stays;
    }
    return {.position = centre_, .radius = radius_};
  }

  const SamplesOnFaces& samples_;
  const Faces& faces_;
  Vec3 start_, along_, centre_;
  double radius_ = 0;
  std::vector<int32_t> walls_;  // triangles
  std::vector<Foot> feet_;      // on them
  std::vector<Vec3> touched_;   // the slopes of the distances to walls that the ball touches
};

}  // namespace

Touch held_ball(const SamplesOnFaces& samples, const Vec3& start, const Vec3& along) {
  return Climb(samples, start, along).climb();
}

}  // namespace medial
