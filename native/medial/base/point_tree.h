// SPDX-License-Identifier: GPL-3.0-or-later
// A point tree has boxes over points that lie along a Hilbert curve: over runs of points, over runs
// of boxes, and so on. Building it needs no sorting. It answers every query that can be decided by
// boxes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/nearest.h"
#include "base/vec3.h"

namespace medial {

// Its const members may be called from several threads.
class PointTree {
 public:
  PointTree() = default;
  // Keeps a copy of the points. Points next to each other in the list should be close in space.
  explicit PointTree(std::span<const Vec3> points);

  const Vec3& operator[](int32_t id) const { return points_[id]; }
  int32_t size() const { return static_cast<int32_t>(points_.size()); }
  size_t bytes() const;

  // Returns the nearest point, ties by lowest id. The tree must not be empty.
  Neighbour nearest(const Vec3& query) const;
  // Does the same, but faster, if some point is known to lie within this distance.
  Neighbour nearest(const Vec3& query, double within) const;
  // Returns the distance that holds the `count` nearest points, those at the query included, or all
  // points if there are fewer.
  double reach(const Vec3& query, size_t count) const;
  // Calls found(id), ascending, for the points of every smallest box that wanted(box) accepts along
  // with all boxes around it.
  template <typename Wanted, typename Found>
  void visit(const Wanted& wanted, const Found& found) const {
    if (!levels_.empty()) visit(levels_.size() - 1, 0, wanted, found);
  }

 private:
  static constexpr size_t kRun = 8, kFan = 4;  // points to a box, boxes to a larger one

  struct Children {
    size_t begin, end;
  };
  Children children(size_t level, size_t box) const {
    const size_t fan = level == 0 ? kRun : kFan,
                 all = level == 0 ? points_.size() : levels_[level - 1].size();
    return {box * fan, std::min(all, box * fan + fan)};
  }

  template <typename Wanted, typename Found>
  void visit(size_t level, size_t box, const Wanted& wanted, const Found& found) const {
    if (!wanted(levels_[level][box])) return;
    const auto [begin, end] = children(level, box);
    for (size_t i = begin; i < end; ++i) {
      if (level == 0) {
        found(static_cast<int32_t>(i));
      } else {
        visit(level - 1, i, wanted, found);
      }
    }
  }
  template <typename Search>
  void descend(size_t level, size_t box, const Vec3& query, Search& search) const;

  std::vector<Vec3> points_;
  std::vector<std::vector<Box>> levels_;  // the last one is a single box
};

}  // namespace medial
