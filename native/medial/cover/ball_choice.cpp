// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/ball_choice.h"

#include <queue>

#include "base/parallel.h"
#include "base/rows.h"

namespace medial {
namespace {

constexpr int64_t kBalls = 256;  // balls in one piece of work
// A ball is near the farthest place if it leaves at most this share of the distance.
constexpr double kNear = 0.25;  // chosen: balls

// This is an upper bound of the places that a ball would cover: the number at its last count.
struct Gain {
  int64_t places;
  int32_t ball;

  bool operator<(const Gain& other) const {
    return places != other.places ? places < other.places : ball > other.ball;
  }
};

std::vector<Gain> gains_of(std::span<const int32_t> ids, std::span<const Ball> balls,
                           const SolidLattice& left, const Run& run) {
  std::vector<Gain> gains(ids.size());
  parallel_for(
      static_cast<int64_t>(ids.size()), {run.threads},
      [&](int64_t i) {
        throw_if_cancelled(run.progress);
        const auto& [centre, radius] = balls[ids[i]];
        gains[i] = {left.count(centre, radius), ids[i]};
      },
      kBalls);
  return gains;
}

std::vector<int32_t> ids_in_solid(std::span<const Ball> balls) {
  return rows_where(balls.size(), [&](int32_t i) { return balls[i].radius > 0; });
}

// This holds the balls chosen so far, and the places that they leave.
class Chosen {
 public:
  Chosen(std::span<const Ball> balls, int64_t count, SolidLattice& left, const Run& run)
      : balls_(balls), count_(count), left_(left), run_(run) {}

  bool is_full() const { return static_cast<int64_t>(choice_.chosen.size()) >= count_; }

  void add(const Gain& gain) {
    const auto& [centre, radius] = balls_[gain.ball];
    left_.remove(centre, radius);
    held_ += gain.places;
    choice_.chosen.push_back(gain.ball);
    choice_.covered.push_back(static_cast<double>(held_) / static_cast<double>(left_.count()));
    const auto size = static_cast<double>(choice_.chosen.size());
    advance(run_.progress, size / static_cast<double>(count_));
  }

  BallChoice take() { return std::move(choice_); }

 private:
  std::span<const Ball> balls_;
  int64_t count_;
  SolidLattice& left_;
  const Run& run_;
  BallChoice choice_;
  int64_t held_ = 0;
};

// This holds places of the solid and their distances to the balls so far, negative inside them.
class Distances {
 public:
  explicit Distances(std::vector<Vec3> places)
      : places_(std::move(places)), away_(places_.size(), HUGE_VAL) {
    for (size_t i = 0; i < places_.size(); ++i) queue_.emplace(HUGE_VAL, ~i);
  }

  // Returns the farthest place, ties by lowest id. Distances only shrink, so a place that is first
  // in the queue with the distance that it has now is the farthest.
  size_t farthest() {
    while (true) {
      const auto [away, id] = queue_.top();
      if (away_[~id] == away) return ~id;
      queue_.pop();
      queue_.emplace(away_[~id], id);
    }
  }
  const Vec3& place(size_t i) const { return places_[i]; }
  double away(size_t i) const { return away_[i]; }
  void settle(size_t i) { away_[i] = -HUGE_VAL; }

  void add(const Ball& ball, const Run& run) {
    parallel_for(static_cast<int64_t>(places_.size()), {run.threads}, [&](int64_t i) {
      away_[i] = std::min(away_[i], distance(places_[i], ball.centre) - ball.radius);
    });
  }

 private:
  std::vector<Vec3> places_;
  std::vector<double> away_;
  std::priority_queue<std::pair<double, size_t>> queue_;  // distances and complements of ids
};

// Returns the balls that come nearest to a place, if they come nearer than `away`.
std::vector<int32_t> balls_near(const Vec3& place, double away, std::span<const int32_t> ids,
                                std::span<const Ball> balls) {
  std::vector<double> gaps;
  gaps.reserve(ids.size());
  double least = HUGE_VAL;
  for (const int32_t id : ids) {
    gaps.push_back(distance(place, balls[id].centre) - balls[id].radius);
    least = std::min(least, gaps.back());
  }
  std::vector<int32_t> near;
  if (!(least < away)) return near;
  const double limit = std::max(kNear * away, least);
  for (size_t i = 0; i < ids.size(); ++i) {
    if (gaps[i] <= limit) near.push_back(ids[i]);
  }
  return near;
}

}  // namespace

// Gains only shrink, so if a recounted one is still the largest, no others need a recount (Minoux
// 1978).
BallChoice balls_by_volume(std::span<const Ball> balls, int64_t count, SolidLattice& left,
                           const Run& run) {
  std::priority_queue<Gain> gains({}, gains_of(ids_in_solid(balls), balls, left, run));
  Chosen chosen(balls, count, left, run);
  while (!chosen.is_full() && !gains.empty()) {
    throw_if_cancelled(run.progress);
    Gain gain = gains.top();
    gains.pop();
    const int64_t before = gain.places;
    gain.places = left.count(balls[gain.ball].centre, balls[gain.ball].radius);
    if (gain.places == 0) continue;
    if (gain.places < before && !gains.empty() && gain < gains.top()) {
      gains.push(gain);
    } else {
      chosen.add(gain);
    }
  }
  return chosen.take();
}

BallChoice balls_by_distance(std::span<const Ball> balls, int64_t count, SolidLattice& left,
                             const Run& run) {
  const auto ids = ids_in_solid(balls);
  Distances distances(left.places());
  Chosen chosen(balls, count, left, run);
  const auto add_best = [&](std::span<const int32_t> some) {
    const auto gains = gains_of(some, balls, left, run);
    const Gain best = *std::max_element(gains.begin(), gains.end());
    chosen.add(best);
    distances.add(balls[best.ball], run);
  };
  if (ids.empty()) return chosen.take();
  add_best(ids);
  while (!chosen.is_full()) {
    throw_if_cancelled(run.progress);
    const size_t worst = distances.farthest();
    const double away = distances.away(worst);
    if (away <= 0) break;
    const auto near = balls_near(distances.place(worst), away, ids, balls);
    if (near.empty()) {
      distances.settle(worst);
    } else {
      add_best(near);
    }
  }
  return chosen.take();
}

}  // namespace medial
