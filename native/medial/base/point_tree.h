// SPDX-License-Identifier: GPL-3.0-or-later
// A point tree has boxes over points that lie along a Hilbert curve: over runs of points, over runs
// of boxes, and so on. It answers every query that can be decided by boxes.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "base/run.h"
#include "base/vec3.h"

namespace medial {

struct Neighbour {
  double distance;
  int32_t id;

  friend auto operator<=>(const Neighbour&, const Neighbour&) = default;
};

// Its const members may be called from several threads.
class PointTree {
 public:
  PointTree() = default;
  // Keeps a copy of the points, whose ids are their positions in the list. Points next to each
  // other in the list should be close in space; of points in any order use `sorted`.
  explicit PointTree(std::span<const Vec3> points);
  // Sorts the points along a Hilbert curve first. Their ids are still their positions in the list.
  static PointTree sorted(std::span<const Vec3> points, const Run& run);

  // The tree must not be a sorted one.
  const Vec3& operator[](int32_t id) const { return points_[id]; }
  int32_t size() const { return static_cast<int32_t>(points_.size()); }
  size_t bytes() const;

  // Returns the nearest point, ties by lowest id; of an empty tree the id -1 at infinity.
  Neighbour nearest(const Vec3& query) const;
  // Does the same, but faster, if some point is known to lie within this distance.
  Neighbour nearest(const Vec3& query, double within) const;
  // Returns whether a point lies within a distance.
  bool has_within(const Vec3& query, double distance) const;
  // Returns the distance that holds the `count` nearest points, those at the query included, or all
  // points if there are fewer.
  double reach(const Vec3& query, size_t count) const;
  // Finds the `count` nearest points, nearest first and ties by lowest id, or all if there are
  // fewer.
  void find(const Vec3& query, size_t count, std::vector<Neighbour>& found) const;
  // Calls found(point) for the points of every smallest box that wanted(box) accepts along with all
  // boxes around it.
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
        found(points_[i]);
      } else {
        visit(level - 1, i, wanted, found);
      }
    }
  }
  int32_t id(size_t i) const { return ids_.empty() ? static_cast<int32_t>(i) : ids_[i]; }
  template <typename Search>
  void search(const Vec3& query, Search& search) const;
  template <typename Search>
  void descend(size_t level, size_t box, const Vec3& query, Search& search) const;

  std::vector<Vec3> points_;
  std::vector<int32_t> ids_;              // of each point; empty if they are the positions
  std::vector<std::vector<Box>> levels_;  // the last one is a single box
};

}  // namespace medial
