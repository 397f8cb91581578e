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

// Finds the highest place of the distance to the faces in a plane by Kelley's method of cutting
// planes. Each foot of a place that was tried gives a plane, and the next place is the highest one
// of the lowest planes. A flat wall is one plane, and all planes of a round bar meet in its axis.
class Climb {
 public:
  Climb(const SamplesOnFaces& samples, const Vec3& start, const Vec3& along)
      : samples_(samples), faces_(samples.faces()), start_(start), along_(along), centre_(start) {}

  Touch climb() {
    const auto first = nearest();
    if (!first || !is_inside(*first)) return {};
    const Touch stays{.position = start_, .radius = first->distance};
    reach_ = first->distance;
    add(*first);
    for (int i = 0; i < kSteps; ++i) {
      for (int k = 0; k < kSteps && step(); ++k) {
      }
      const auto foot = nearest();
      if (!foot) return stays;
      const double depth = foot->distance;
      if (is_inside(*foot) && height() <= (1 + kAsNear) * depth) {
        const Touch held{.position = centre_, .radius = depth};
        return samples_.are_near(foot->point) && is_better(held, *foot, *first) ? held : stays;
      }
      add(*foot);
    }
    return stays;
  }

 private:
  struct Plane {
    Vec3 slope;
    double at_start;
  };

  // Walls of a smooth section may be so nearly as far away along a way that its highest place tells
  // less than the samples do. So a ball that they hold counts if they are round, that is, if the
  // distance grows along the whole way as to flat walls with the sharp angle between them, and if a
  // hole between the samples is as wide as the radius of the ball.
  bool is_better(const Touch& held, const Foot& foot, const Foot& first) const {
    const double moved = distance(held.position, start_);
    if (!(moved < held.radius)) return false;
    if (!(faces_.bulge(foot.triangle) > kAsNear * held.radius)) return true;
    return held.radius - first.distance > samples_.most_alike() * moved &&
           2 * samples_.hole_near(start_) > first.distance;
  }

  std::optional<Foot> nearest() const {
    const auto near = faces_.nearest_lifted(
        {.from = centre_}, [&](const Foot& foot) { return !samples_.are_near(foot.point); });
    return near ? std::optional(faces_.descend_again(*near, centre_)) : std::nullopt;
  }

  bool is_inside(const Foot& foot) const {
    return dot(centre_ - foot.point, faces_.normal(foot.triangle, foot.at)) < 0;
  }

  // Returns the direction in which the signed distance grows.
  Vec3 inwards(const Foot& foot) const {
    if (!(foot.distance > kAsNear * reach_)) return -1 * faces_.normal(foot.triangle, foot.at);
    return (is_inside(foot) ? 1 : -1) * normalized(centre_ - foot.point);
  }

  // The distance is negative outside.
  void add(const Foot& foot) {
    const Vec3 away = inwards(foot), slope = away - dot(away, along_) * along_;
    const double depth = is_inside(foot) ? foot.distance : -foot.distance;
    planes_.push_back({slope, depth - dot(slope, centre_ - start_)});
  }

  double height(const Plane& plane) const {
    return plane.at_start + dot(plane.slope, centre_ - start_);
  }

  double height() const {
    double least = HUGE_VAL;
    for (const Plane& plane : planes_) least = std::min(least, height(plane));
    return least;
  }

  std::vector<Vec3> lowest(double low) const {
    std::vector<Vec3> slopes;
    for (const Plane& plane : planes_) {
      if (is_low(plane, low)) slopes.push_back(plane.slope);
    }
    return slopes;
  }

  // Goes up along the lowest planes until another one is as low. Returns false at the top; where no
  // plane ends the way, it is one first radius on.
  bool step() {
    const double low = height();
    const Vec3 way = shortest_of_hull(lowest(low));
    const double growth = squared_length(way);
    if (!(growth > kSameFoot * kSameFoot)) return false;
    double share = HUGE_VAL;
    for (const Plane& plane : planes_) {
      const double falls = growth - dot(plane.slope, way);
      if (!is_low(plane, low) && falls > 0) share = std::min(share, (height(plane) - low) / falls);
    }
    const bool ends = share < HUGE_VAL;
    centre_ = centre_ + (ends ? share : reach_ / std::sqrt(growth)) * way;
    return ends;
  }

  bool is_low(const Plane& plane, double low) const {
    return height(plane) <= low + kAsNear * reach_;
  }

  const SamplesOnFaces& samples_;
  const Faces& faces_;
  Vec3 start_, along_, centre_;
  double reach_ = 0;
  std::vector<Plane> planes_;
};

}  // namespace

Touch held_ball(const SamplesOnFaces& samples, const Vec3& start, const Vec3& along) {
  return Climb(samples, start, along).climb();
}

}  // namespace medial
