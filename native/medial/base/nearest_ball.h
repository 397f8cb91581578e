// SPDX-License-Identifier: GPL-3.0-or-later
// This class finds the nearest of many fixed balls, by the distance to their surfaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

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
  struct Node {
    Box box = {};  // bounds the centres
    double largest = 0;
    int32_t begin = 0, end = 0;
    int32_t right = -1;  // the left child follows its parent; -1: a leaf
  };
  struct Best {
    double distance = HUGE_VAL;
    int32_t id = -1;
  };

  int32_t build(int32_t begin, int32_t end);
  void search(int32_t id, const Vec3& query, Best& best) const;
  static double bound(const Node& node, const Vec3& query);

  std::vector<Ball> balls_;
  std::vector<int32_t> order_;  // ids, leaf after leaf
  std::vector<Node> nodes_;
};

}  // namespace medial
