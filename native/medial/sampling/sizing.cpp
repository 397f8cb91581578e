#include "sampling/sizing.h"

#include <numeric>
#include <queue>

namespace medial {
namespace {

double coordinate(const Vec3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace

KdTree::KdTree(std::span<const Vec3> points)
    : points_(points), order_(points.size()), axis_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  build(0, points.size());
}

void KdTree::build(size_t begin, size_t end) {
  if (end - begin < 2) return;
  Box box;
  for (size_t i = begin; i < end; ++i) box.add(points_[order_[i]]);
  const Vec3 e = box.extent();
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const size_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int32_t a, int32_t b) {
                     const double x = coordinate(points_[a], axis),
                                  y = coordinate(points_[b], axis);
                     return x != y ? x < y : a < b;
                   });
  axis_[middle] = static_cast<uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

void KdTree::nearest(const Vec3& query, size_t count,
                     std::vector<std::pair<double, int32_t>>& found) const {
  found.clear();
  search(0, order_.size(), query, count, found);
  for (auto& [squared, id] : found) squared = std::sqrt(squared);
}

void KdTree::search(size_t begin, size_t end, const Vec3& query, size_t count,
                    std::vector<std::pair<double, int32_t>>& found) const {
  if (begin == end) return;
  const size_t middle = begin + (end - begin) / 2;
  const int32_t id = order_[middle];
  const std::pair<double, int32_t> here{squared_length(points_[id] - query), id};
  if (found.size() < count || here < found.back()) {
    if (found.size() == count) found.pop_back();
    found.insert(std::upper_bound(found.begin(), found.end(), here), here);
  }
  const int axis = axis_[middle];
  const double beyond = coordinate(query, axis) - coordinate(points_[id], axis);
  const bool low = beyond < 0;
  search(low ? begin : middle + 1, low ? middle : end, query, count, found);
  if (found.size() == count && beyond * beyond > found.back().first) return;
  search(low ? middle + 1 : begin, low ? end : middle, query, count, found);
}

SizingField::SizingField(std::span<const Vec3> sites, std::span<const double> spacings,
                         const Run& run)
    : tree_(sites), spacing_(spacings.begin(), spacings.end()) {
  constexpr size_t kNeighbours = 9;  // the site itself among them
  std::vector<std::vector<std::pair<double, int32_t>>> near(sites.size());
  parallel_for(static_cast<int64_t>(sites.size()), run,
               [&](int64_t i) { tree_.nearest(sites[i], kNeighbours, near[i]); });
  using Limit = std::pair<double, int32_t>;
  std::priority_queue<Limit, std::vector<Limit>, std::greater<>> queue;
  for (size_t i = 0; i < sites.size(); ++i) queue.push({spacing_[i], static_cast<int32_t>(i)});
  while (!queue.empty()) {
    const auto [spacing, i] = queue.top();
    queue.pop();
    if (spacing > spacing_[i]) continue;
    for (const auto& [away, j] : near[i]) {
      const double limit = spacing + kGrading * away;
      if (limit >= spacing_[j]) continue;
      spacing_[j] = limit;
      queue.push({limit, j});
    }
  }
}

double SizingField::operator()(const Vec3& place) const {
  thread_local std::vector<std::pair<double, int32_t>> found;
  tree_.nearest(place, 1, found);
  return spacing_[found.front().second];
}

}  // namespace medial
