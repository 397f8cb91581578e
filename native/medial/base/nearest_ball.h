// SPDX-License-Identifier: GPL-3.0-or-later
// This class finds the nearest of many fixed balls, by the distance to their surfaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/box_tree.h"

namespace medial {

struct Ball {
  Vec3 centre;
  double radius = 0;
};

// It keeps a tree of boxes around the centres, each with the largest radius in it. It is safe to
// use from several threads.
class NearestBall {
 public:
  explicit NearestBall(std::span<const Ball> balls);

  // Returns the ball with the least |query - centre| - radius, ties by lowest id, or -1 if there
  // are no balls.
  int32_t find(const Vec3& query) const;

 private:
  struct Node : TreeNode {
    Box box;  // bounds the centres
    double largest = 0;
  };

  static double bound(const Node& node, const Vec3& query);

  std::vector<Ball> balls_;
  std::vector<int32_t> order_;  // ids, leaf after leaf
  std::vector<Node> nodes_;
};

}  // namespace medial
