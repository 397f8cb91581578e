// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/ball_bound.h"

#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "base/rows.h"
#include "cover/ball_places.h"

namespace medial {
namespace {

constexpr double kSearched = 0.01;  // the search ends at this share of the bound; chosen: unseen
constexpr int64_t kServersOfTask = 16;  // balls in one piece of work

// This finds balls that serve all places, for any bound.
class Service {
 public:
  Service(std::span<const Ball> balls, std::span<const int32_t> ids,
          std::span<const BoundedPlace> places, const Run& run)
      : balls_(balls), ids_(ids), places_(places.begin(), places.end()), run_(run) {
    const int32_t largest = *std::max_element(ids.begin(), ids.end(), [&](int32_t a, int32_t b) {
      return balls[a].radius < balls[b].radius;
    });
    std::vector<double> away;
    for (const auto& place : places) away.push_back(distance(place.at, balls[largest].centre));
    std::vector<int32_t> order = all_rows(places.size());
    std::sort(order.begin(), order.end(),
              [&](int32_t a, int32_t b) { return std::tie(away[b], a) < std::tie(away[a], b); });
    for (size_t i = 0; i < order.size(); ++i) places_[i] = places[order[i]];
  }

  // Returns at most `most` balls that serve all places, or nothing if it finds none.
  std::vector<int32_t> within(double bound, int64_t most) const {
    std::vector<BoundedPlace> left(places_);
    std::vector<int32_t> chosen;
    while (!left.empty()) {
      throw_if_cancelled(run_.progress);
      const int32_t best = best_server(left, bound);
      if (best < 0 || static_cast<int64_t>(chosen.size()) == most) return {};
      chosen.push_back(best);
      std::erase_if(left, [&](const auto& place) { return serves(balls_[best], place, bound); });
    }
    return chosen;
  }

 private:
  static bool serves(const Ball& ball, const BoundedPlace& place, double bound) {
    return gap(ball, place.at) <= place.limit(bound);
  }

  // Returns the ball that serves the first place and most of the others, ties by order, or -1.
  int32_t best_server(std::span<const BoundedPlace> left, double bound) const {
    std::vector<int32_t> servers;
    double reach = 0;
    for (const int32_t id : ids_) {
      if (!serves(balls_[id], left[0], bound)) continue;
      servers.push_back(id);
      reach = std::max(reach, 2 * balls_[id].radius + left[0].limit(bound));
    }
    std::vector<BoundedPlace> near;
    for (const BoundedPlace& place : left) {
      if (distance(place.at, left[0].at) <= reach + place.limit(bound)) near.push_back(place);
    }
    std::vector<int64_t> served(servers.size());
    parallel_for(
        static_cast<int64_t>(servers.size()), {run_.threads},
        [&](int64_t i) {
          const Ball& ball = balls_[servers[i]];
          served[i] = std::count_if(near.begin(), near.end(),
                                    [&](const auto& place) { return serves(ball, place, bound); });
        },
        kServersOfTask);
    if (servers.empty()) return -1;
    return servers[std::max_element(served.begin(), served.end()) - served.begin()];
  }

  std::span<const Ball> balls_;
  std::span<const int32_t> ids_;
  std::vector<BoundedPlace> places_;  // those farthest from the largest ball first
  const Run& run_;
};

}  // namespace

BoundedBalls bounded_balls(std::span<const Ball> balls, std::span<const int32_t> ids,
                           std::span<const BoundedPlace> places, int64_t most, double fine,
                           BoundedBalls first, const Run& run) {
  const Service service(balls, ids, places, run);
  BoundedBalls best(std::move(first));
  double low = 0;
  while (best.bound > fine && best.bound - low > kSearched * best.bound) {
    const double middle = 0.5 * low + 0.5 * best.bound;
    auto found = service.within(middle, most);
    if (found.empty()) {
      low = middle;
    } else {
      best = {middle, std::move(found)};
    }
  }
  return best;
}

}  // namespace medial
