// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/smooth_rim.h"

namespace medial {
namespace {

// A smooth rim is looked for where a ball touches two places that are seen under less than 84
// degrees.
constexpr double kMostOpen = 0.45;    // the squared sine of half the angle; chosen: axis
constexpr double kFarOut = 0.8;       // of the way to the rim that balls are tried on; chosen: axis
constexpr double kFarthestRim = 0.5;  // from the last vertex to the rim, in radii; chosen: axis
constexpr double kBent = 0.4;         // deviation from a line, as a share of openness; chosen: axis
constexpr int kRimSteps = 4;

// Fits a parabola through the origin to how much of the openness is lost on the way.
class Loss {
 public:
  void add(double along, double lost) {
    at_.push_back({along, lost});
    const double squared = along * along;
    s2_ += squared;
    s3_ += squared * along;
    s4_ += squared * squared;
    t1_ += along * lost;
    t2_ += squared * lost;
  }

  // Returns where all of it is lost; infinite if it does not fall, or not nearly linearly.
  double end(double openness) const {
    const double slope = t1_ / s2_;
    if (!(slope > 0)) return HUGE_VAL;
    for (const auto& [along, lost] : at_) {
      if (!(std::abs(lost - slope * along) < kBent * openness)) return HUGE_VAL;
    }
    const double determinant = s2_ * s4_ - s3_ * s3_;
    if (at_.size() < 3 || !(determinant > 0)) return openness / slope;
    const double linear = (t1_ * s4_ - t2_ * s3_) / determinant,
                 square = (t2_ * s2_ - t1_ * s3_) / determinant;
    const double root = linear * linear + 4 * square * openness;
    return linear > 0 && root > 0 ? 2 * openness / (linear + std::sqrt(root)) : openness / slope;
  }

 private:
  std::vector<std::array<double, 2>> at_;
  double s2_ = 0, s3_ = 0, s4_ = 0, t1_ = 0, t2_ = 0;
};

// Returns how far the openness of the balls after some steps lets the rim be. At the rim of a
// fillet it drops at once where the balls of the fillet have their common centre.
double distance_to_rim(const Faces& faces, const Touch& inner, const Vec3& step, int steps) {
  Walls walls = inner.walls;
  Vec3 position = inner.position;
  const double first = openness(inner.away);
  Loss loss;
  for (int i = 0; i < steps; ++i) {
    const TouchingBall ball = touching_ball(faces, walls.all(), position + step);
    position = ball.centre;
    loss.add(distance(position, inner.position), first - openness(ball.away));
  }
  return loss.end(first);
}

}  // namespace

// The openness falls nearly linearly towards the rim, where it is 0. The line is fitted to several
// balls on the way, because the curvature of curved triangles jumps from one to the next.
SmoothRim smooth_rim_of(const Faces& faces, double hole, const Touch& inner) {
  if (!(openness(inner.away) < kMostOpen)) return {};
  const double farthest = kFarthestRim * inner.radius;
  const Vec3 outward = -normalized(inner.away[0] + inner.away[1]);
  double reach = distance_to_rim(faces, inner, 0.25 * hole * outward, 1);
  for (int i = 0; i < 2; ++i) {
    if (!(reach < farthest)) return {};
    reach = distance_to_rim(faces, inner, (kFarOut * reach / kRimSteps) * outward, kRimSteps);
  }
  return reach < farthest ? SmoothRim{reach} : SmoothRim{};
}

}  // namespace medial
