// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/sizing.h"

#include <queue>

namespace medial {

namespace {

using Neighbours = std::vector<std::vector<Neighbour>>;

// Makes each of two sites a neighbour of the other one.
void add_other_ways(Neighbours& near) {
  const Neighbours one_way = near;
  for (size_t i = 0; i < one_way.size(); ++i) {
    for (const auto& [away, j] : one_way[i]) near[j].push_back({away, static_cast<int32_t>(i)});
  }
}

}  // namespace

SizingField::SizingField(std::span<const Vec3> sites, std::span<const double> spacings,
                         const Run& run, bool across)
    : sites_(PointTree::sorted(sites, run)), spacing_(spacings.begin(), spacings.end()) {
  constexpr size_t kNeighbours = 9;  // the site itself is one of them
  Neighbours near(sites.size());
  parallel_for(static_cast<int64_t>(sites.size()), run,
               [&](int64_t i) { sites_.find(sites[i], kNeighbours, near[i]); });
  if (across) add_other_ways(near);
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
  return spacing_[sites_.nearest(place).id];
}

}  // namespace medial
