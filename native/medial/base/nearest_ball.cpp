// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/nearest_ball.h"

#include <tuple>

#include "base/rows.h"

namespace medial {
namespace {

constexpr int32_t kLeaf = 8;

}  // namespace

NearestBall::NearestBall(std::span<const Ball> balls)
    : balls_(balls.begin(), balls.end()), order_(all_rows(balls.size())) {
  const auto describe = [&](Node& node) {
    for (int32_t i = node.begin; i < node.end; ++i) {
      node.box.add(balls_[order_[i]].centre);
      node.largest = std::max(node.largest, balls_[order_[i]].radius);
    }
  };
  const auto split = [&](const Node& node) {
    const int axis = longest_axis(node.box.extent());
    return split_in_middle(order_, node.begin, node.end, [&](int32_t ball) {
      return std::tuple(coordinate(balls_[ball].centre, axis), ball);
    });
  };
  if (balls.empty()) return;
  build_tree(nodes_, 0, static_cast<int32_t>(balls_.size()), kLeaf, describe, split);
}

int32_t NearestBall::find(const Vec3& query) const {
  double least = HUGE_VAL;
  int32_t nearest = -1;
  const auto visit = [&](const Node& leaf) {
    for (int32_t i = leaf.begin; i < leaf.end; ++i) {
      const int32_t ball = order_[i];
      const double away = distance(query, balls_[ball].centre) - balls_[ball].radius;
      if (std::tie(away, ball) < std::tie(least, nearest))
        std::tie(least, nearest) = std::tuple(away, ball);
    }
  };
  if (!nodes_.empty()) {
    visit_nearest(
        nodes_, 0, [&](const Node& node) { return bound(node, query); }, [&] { return least; },
        visit);
  }
  return nearest;
}

// Returns a lower bound, up to rounding, of the distance to the balls of a node.
double NearestBall::bound(const Node& node, const Vec3& query) {
  return std::sqrt(squared_distance(node.box, query)) - node.largest;
}

}  // namespace medial
