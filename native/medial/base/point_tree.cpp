// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/point_tree.h"

#include <algorithm>

#include "base/rows.h"

namespace medial {
namespace {

struct NearestOne {
  Neighbour best{HUGE_VAL, -1};  // by squared distance

  double bound() const { return best.distance; }
  void meet(const Neighbour& point) { best = std::min(best, point); }
};

// Ends at the first point that is near enough.
struct AnyWithin {
  double squared;
  bool found = false;

  double bound() const { return found ? -1 : squared; }
  void meet(const Neighbour& point) { found |= point.distance <= squared; }
};

struct NearestFew {
  size_t count;
  std::vector<Neighbour>& heap;  // by squared distances, the farthest first

  double bound() const { return heap.size() < count ? HUGE_VAL : heap.front().distance; }
  void meet(const Neighbour& point) {
    if (heap.size() == count) {
      if (heap.front() < point) return;
      std::pop_heap(heap.begin(), heap.end());
      heap.pop_back();
    }
    heap.push_back(point);
    std::push_heap(heap.begin(), heap.end());
  }
};

}  // namespace

PointTree::PointTree(std::span<const Vec3> points) : points_(points.begin(), points.end()) {
  for (size_t below = points_.size(); below > 1 || levels_.empty(); below = levels_.back().size()) {
    if (below == 0) return;
    const size_t level = levels_.size(), fan = level == 0 ? kRun : kFan;
    levels_.emplace_back((below + fan - 1) / fan);
    for (size_t box = 0; box < levels_[level].size(); ++box) {
      Box& all = levels_[level][box];
      const auto [begin, end] = children(level, box);
      for (size_t i = begin; i < end; ++i) {
        all.add(level == 0 ? points_[i] : levels_[level - 1][i].low);
        all.add(level == 0 ? points_[i] : levels_[level - 1][i].high);
      }
    }
  }
}

PointTree PointTree::sorted(std::span<const Vec3> points, const Run& run) {
  const auto order = hilbert_order(points, run);
  PointTree tree(rows_of(points, order));
  tree.ids_.assign(order.begin(), order.end());
  return tree;
}

size_t PointTree::bytes() const {
  size_t boxes = 0;
  for (const auto& level : levels_) boxes += level.size();
  return points_.size() * sizeof(Vec3) + ids_.size() * sizeof(int32_t) + boxes * sizeof(Box);
}

template <typename Search>
void PointTree::search(const Vec3& query, Search& search) const {
  if (!levels_.empty()) descend(levels_.size() - 1, 0, query, search);
}

template <typename Search>
void PointTree::descend(size_t level, size_t box, const Vec3& query, Search& search) const {
  const auto [begin, end] = children(level, box);
  if (level == 0) {
    for (size_t i = begin; i < end; ++i) {
      search.meet({squared_length(points_[i] - query), id(i)});
    }
    return;
  }
  // Nearest boxes first.
  std::array<std::pair<double, size_t>, kFan> order;
  const size_t count = end - begin;
  for (size_t i = 0; i < count; ++i) {
    const std::pair next(squared_distance(levels_[level - 1][begin + i], query), begin + i);
    size_t at = i;
    for (; at > 0 && next < order[at - 1]; --at) order[at] = order[at - 1];
    order[at] = next;
  }
  for (size_t i = 0; i < count; ++i) {
    if (order[i].first > search.bound()) return;
    descend(level - 1, order[i].second, query, search);
  }
}

Neighbour PointTree::nearest(const Vec3& query) const {
  NearestOne one;
  search(query, one);
  return {std::sqrt(one.best.distance), one.best.id};
}

Neighbour PointTree::nearest(const Vec3& query, double within) const {
  NearestOne one{{within * within, size()}};
  search(query, one);
  // The known distance may be wrong in its last bits.
  if (one.best.id == size()) return nearest(query);
  return {std::sqrt(one.best.distance), one.best.id};
}

bool PointTree::has_within(const Vec3& query, double distance) const {
  AnyWithin any{distance * distance};
  search(query, any);
  return any.found;
}

double PointTree::reach(const Vec3& query, size_t count) const {
  std::vector<Neighbour> found;
  find(query, count, found);
  return found.back().distance;
}

void PointTree::find(const Vec3& query, size_t count, std::vector<Neighbour>& found) const {
  found.clear();
  found.reserve(std::min(count, points_.size()) + 1);
  NearestFew few{count, found};
  search(query, few);
  std::sort_heap(found.begin(), found.end());
  for (Neighbour& neighbour : found) neighbour.distance = std::sqrt(neighbour.distance);
}

}  // namespace medial
