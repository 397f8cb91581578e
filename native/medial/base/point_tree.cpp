// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/point_tree.h"

namespace medial {
namespace {

struct NearestOne {
  Neighbour best{HUGE_VAL, -1};  // by squared distance

  double bound() const { return best.distance; }
  void meet(const Neighbour& point) { best = std::min(best, point); }
};

struct NearestFew {
  size_t count;
  std::vector<double> heap;  // squared distances, the largest first

  double bound() const { return heap.size() < count ? HUGE_VAL : heap.front(); }
  void meet(const Neighbour& point) {
    if (heap.size() == count) {
      if (point.distance >= heap.front()) return;
      std::pop_heap(heap.begin(), heap.end());
      heap.pop_back();
    }
    heap.push_back(point.distance);
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

size_t PointTree::bytes() const {
  size_t boxes = 0;
  for (const auto& level : levels_) boxes += level.size();
  return points_.size() * sizeof(Vec3) + boxes * sizeof(Box);
}

template <typename Search>
void PointTree::descend(size_t level, size_t box, const Vec3& query, Search& search) const {
  const auto [begin, end] = children(level, box);
  if (level == 0) {
    for (size_t i = begin; i < end; ++i) {
      search.meet({squared_length(points_[i] - query), static_cast<int32_t>(i)});
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
  NearestOne search;
  descend(levels_.size() - 1, 0, query, search);
  return {std::sqrt(search.best.distance), search.best.id};
}

Neighbour PointTree::nearest(const Vec3& query, double within) const {
  NearestOne search{{within * within, size()}};
  descend(levels_.size() - 1, 0, query, search);
  // The known distance may be wrong in its last bits.
  if (search.best.id == size()) return nearest(query);
  return {std::sqrt(search.best.distance), search.best.id};
}

double PointTree::reach(const Vec3& query, size_t count) const {
  NearestFew search{count, {}};
  search.heap.reserve(count + 1);
  descend(levels_.size() - 1, 0, query, search);
  return std::sqrt(search.heap.front());
}

}  // namespace medial
