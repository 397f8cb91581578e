// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

// A smooth rim is looked for where a ball touches two places that are seen under less than 84
// degrees.
constexpr double kMostOpen = 0.45;          // the squared sine of half the angle
constexpr double kFarOut = 0.8;             // of the way to the rim that balls are tried on
constexpr double kFarthestRim = 0.5;        // from the last vertex to the rim, in radii
constexpr double kLongerThanBeside = 1.25;  // of the way of a vertex to that of its neighbours
constexpr int kRimRounds = 3;
constexpr int kShareRounds = 24;      // of means along the rim of how many have found its end
constexpr double kCertainRim = 0.55;  // of the vertices round one must have found it
constexpr int kGapRounds = 6;         // half the length of the longest gap that is filled
constexpr double kBent = 0.4;  // the largest deviation from a line, as a share of the openness
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
double distance_to_rim(const CrispState& state, const Touch& inner, const Vec3& step, int steps) {
  Walls walls = inner.walls;
  Vec3 position = inner.position;
  const double first = openness(inner.away);
  Loss loss;
  for (int i = 0; i < steps; ++i) {
    const TouchingBall ball = touching_ball(state.samples.faces(), walls.all(), position + step);
    position = ball.centre;
    loss.add(distance(position, inner.position), first - openness(ball.away));
  }
  return loss.end(first);
}

class SmoothRims {
 public:
  explicit SmoothRims(CrispState& state) : c_(state) {}

  void settle() {
    leave_doubtful_rims();
    for (int round = 0; round < kGapRounds; ++round) fill_gaps();
    for (int round = 0; round < kRimRounds; ++round) {
      std::vector<double> settled(c_.smooth_rim.size());
      for_rims([&](int32_t v) { settled[v] = settled_reach(v); });
      for_rims([&](int32_t v) { c_.smooth_rim[v].reach = settled[v]; });
    }
    for_rims([&](int32_t v) {
      const SmoothRim& rim = c_.smooth_rim[v];
      if (rim.reach > 0) c_.end_at(v, c_.made.position[v] + rim.reach * rim.outward);
    });
  }

 private:
  template <typename Found>
  void for_rims(const Found& found) const {
    parallel_for(c_.complex.vertices(), c_.run, [&](int64_t v) {
      if (c_.on_rim[v]) found(static_cast<int32_t>(v));
    });
  }

  // The end of the sheet that a few vertices have found is left where most of those round them have
  // not, as on rough bodies: the rim would become ragged.
  void leave_doubtful_rims() {
    std::vector<double> share(c_.smooth_rim.size()), mean(c_.smooth_rim.size());
    for_rims([&](int32_t v) { share[v] = c_.smooth_rim[v].reach > 0; });
    for (int round = 0; round < kShareRounds; ++round) {
      for_rims([&](int32_t v) {
        double sum = 0;
        for (const int32_t other : c_.beside[v]) sum += share[other];
        mean[v] = 0.5 * share[v] + 0.5 * sum / static_cast<double>(c_.beside[v].size());
      });
      std::swap(share, mean);
    }
    for_rims([&](int32_t v) {
      if (share[v] < kCertainRim) c_.smooth_rim[v].reach = 0;
      is_certain_[v] = share[v] >= kCertainRim;
    });
  }

  // A vertex that has not found the end of the sheet goes as far as its neighbours.
  void fill_gaps() {
    std::vector<SmoothRim> filled(c_.smooth_rim.begin(), c_.smooth_rim.end());
    for_rims([&](int32_t v) {
      if (c_.smooth_rim[v].reach > 0 || !is_certain_[v] || !c_.is_open_rim(v)) return;
      SmoothRim sum;
      int count = 0;
      for (const int32_t other : c_.beside[v]) {
        const SmoothRim& rim = c_.smooth_rim[other];
        if (!(rim.reach > 0)) continue;
        sum.outward = sum.outward + rim.outward;
        sum.reach += rim.reach;
        ++count;
      }
      if (count > 0) filled[v] = {normalized(sum.outward), sum.reach / count};
    });
    std::copy(filled.begin(), filled.end(), c_.smooth_rim.begin());
  }

  // A vertex goes no farther than the rim beside it does.
  double settled_reach(int32_t v) const {
    if (!(c_.smooth_rim[v].reach > 0)) return 0;
    std::vector<double> beside{c_.smooth_rim[v].reach};
    for (const int32_t other : c_.beside[v]) beside.push_back(c_.smooth_rim[other].reach);
    const auto middle = beside.begin() + static_cast<std::ptrdiff_t>((beside.size() - 1) / 2);
    std::nth_element(beside.begin(), middle, beside.end());
    return std::min(c_.smooth_rim[v].reach, kLongerThanBeside * *middle);
  }

  CrispState& c_;
  std::vector<uint8_t> is_certain_ = std::vector<uint8_t>(c_.smooth_rim.size(), 0);
};

}  // namespace

// The openness falls nearly linearly towards the rim, where it is 0. The line is fitted to several
// balls on the way, because the curvature of curved triangles jumps from one to the next.
SmoothRim smooth_rim_of(const CrispState& state, int32_t v, const Touch& inner) {
  if (!(openness(inner.away) < kMostOpen)) return {};
  const double farthest = kFarthestRim * inner.radius;
  const Vec3 outward = -normalized(inner.away[0] + inner.away[1]);
  double reach = distance_to_rim(state, inner, 0.25 * state.spacing_at(v) * outward, 1);
  for (int i = 0; i < 2; ++i) {
    if (!(reach < farthest)) return {};
    reach = distance_to_rim(state, inner, (kFarOut * reach / kRimSteps) * outward, kRimSteps);
  }
  return reach < farthest ? SmoothRim{outward, reach} : SmoothRim{};
}

void settle_smooth_rims(CrispState& state) { SmoothRims(state).settle(); }

}  // namespace medial
