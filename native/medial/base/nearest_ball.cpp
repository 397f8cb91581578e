// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/nearest_ball.h"

#include <numeric>
#include <tuple>

namespace medial {
namespace {

constexpr int32_t kLeaf = 8;

}  // namespace

NearestBall::NearestBall(std::span<const Ball> balls)
    : balls_(balls.begin(), balls.end()), order_(balls.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!balls_.empty()) build(0, static_cast<int32_t>(balls_.size()));
}

int32_t NearestBall::build(int32_t begin, int32_t end) {
  const auto id = static_cast<int32_t>(nodes_.size());
  Node node{.begin = begin, .end = end};
  for (int32_t i = begin; i < end; ++i) {
    node.box.add(balls_[order_[i]].centre);
    node.largest = std::max(node.largest, balls_[order_[i]].radius);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return id;
  const int axis = longest_axis(node.box.extent());
  const int32_t middle = begin + (end - begin) / 2;
  const auto key = [&](int32_t ball) {
    return std::tuple(coordinate(balls_[ball].centre, axis), ball);
  };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int32_t a, int32_t b) { return key(a) < key(b); });
  build(begin, middle);
  const int32_t right = build(middle, end);
  nodes_[id].right = right;
  return id;
}

int32_t NearestBall::find(const Vec3& query) const {
  Best best;
  if (!nodes_.empty()) search(0, query, best);
  return best.id;
}

void NearestBall::search(int32_t id, const Vec3& query, Best& best) const {
  const Node& node = nodes_[id];
  if (bound(node, query) > best.distance) return;
  if (node.right < 0) {
    for (int32_t i = node.begin; i < node.end; ++i) {
      const int32_t ball = order_[i];
      const double away = distance(query, balls_[ball].centre) - balls_[ball].radius;
      if (std::tie(away, ball) < std::tie(best.distance, best.id)) best = {away, ball};
    }
    return;
  }
  int32_t near = id + 1, far = node.right;
  if (bound(nodes_[far], query) < bound(nodes_[near], query)) std::swap(near, far);
  search(near, query, best);
  search(far, query, best);
}

// Returns a lower bound, up to rounding, of the distance to the balls of a node.
double NearestBall::bound(const Node& node, const Vec3& query) {
  return std::sqrt(squared_distance(node.box, query)) - node.largest;
}

}  // namespace medial
