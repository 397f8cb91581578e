// SPDX-License-Identifier: GPL-3.0-or-later
// A tree of boxes answers queries of the distance to triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/box_tree.h"

namespace medial {

// It is safe to use from several threads.
class TriangleTree {
 public:
  // Keeps a copy. Triangles may have no area. There must be at least one.
  TriangleTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

  // Returns the distance from a point to the nearest triangle.
  double distance(const Vec3& query) const;

 private:
  struct Corners {
    Vec3 a, b, c;
  };

  static double squared_distance(const Corners& triangle, const Vec3& query);

  std::vector<Corners> triangles_;  // leaf after leaf
  std::vector<BoxNode> nodes_;
};

}  // namespace medial
