// SPDX-License-Identifier: GPL-3.0-or-later
// A tree of boxes answers queries of the distance to triangles.
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "base/box_tree.h"

namespace medial {

// It is safe to use from several threads.
class TriangleTree {
 public:
  // Keeps a copy. Triangles may have no area. There must be at least one.
  TriangleTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

  // Returns the distance from a point to the nearest triangle.
  double distance(const Vec3& query) const { return std::sqrt(found(query).squared); }
  // Returns the row of the nearest triangle; the first one of several.
  int32_t nearest(const Vec3& query) const { return found(query).row; }

 private:
  struct Corners {
    Vec3 a, b, c;
    int32_t row;
  };
  struct Nearest {
    double squared = HUGE_VAL;
    int32_t row = -1;
    bool operator<(const Nearest& other) const {
      return std::tie(squared, row) < std::tie(other.squared, other.row);
    }
  };

  Nearest found(const Vec3& query) const;

  static double squared_distance(const Corners& triangle, const Vec3& query);

  std::vector<Corners> triangles_;  // leaf after leaf
  std::vector<BoxNode> nodes_;
};

}  // namespace medial
