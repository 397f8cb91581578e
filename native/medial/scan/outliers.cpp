// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/outliers.h"

#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "base/rows.h"
#include "scan/local_quadric.h"

namespace medial {
namespace {

constexpr size_t kFew = 12;
constexpr double kAlone = 4;  // times the distance usual among neighbours; chosen: unseen
constexpr double kEmpty = 0.8 * std::numbers::pi;  // a wider empty sector: a border; chosen: unseen
constexpr int64_t kLooked = 4000;  // determine a share of a percent to a fifth of it
constexpr size_t kAround = 24;

// The neighbours of every point, but itself: (n * kFew) ids, their least and mean distance.
struct Neighbourhoods {
  std::vector<int32_t> ids;
  std::vector<double> least, mean;
};

Neighbourhoods neighbourhoods(const PointTree& tree, const Run& run) {
  const int64_t count = tree.size();
  Neighbourhoods all{std::vector<int32_t>(static_cast<size_t>(count) * kFew, -1),
                     std::vector<double>(static_cast<size_t>(count), 0),
                     std::vector<double>(static_cast<size_t>(count), 0)};
  parallel_chunks(
      count, run,
      [&](int64_t begin, int64_t end, int) {
        std::vector<Neighbour> near;
        for (int64_t i = begin; i < end; ++i) {
          tree.find(tree[static_cast<int32_t>(i)], kFew + 1, near);
          size_t slot = 0;
          double sum = 0;
          for (const auto& [distance, id] : near) {
            if (id == i || slot == kFew) continue;
            if (slot == 0) all.least[i] = distance;
            all.ids[static_cast<size_t>(i) * kFew + slot++] = id;
            sum += distance;
          }
          all.mean[i] = slot > 0 ? sum / static_cast<double>(slot) : 0;
        }
      },
      512);
  return all;
}

}  // namespace

std::vector<int32_t> lone_points(const PointTree& tree, const Run& run) {
  if (static_cast<size_t>(tree.size()) <= 2 * kFew) return {};
  const Neighbourhoods all = neighbourhoods(tree, run);
  const auto near_of = [&](int64_t i) {
    return std::span(all.ids).subspan(static_cast<size_t>(i) * kFew, kFew);
  };
  std::vector<uint8_t> far(static_cast<size_t>(tree.size()), 0);
  parallel_for(tree.size(), run, [&](int64_t i) {
    std::array<double, kFew> theirs;
    size_t slot = 0;
    for (const int32_t id : near_of(i)) theirs[slot++] = all.mean[id];
    // The lower quartile: other points that stand alone may be among the neighbours.
    std::nth_element(theirs.begin(), theirs.begin() + kFew / 4, theirs.end());
    far[i] = all.least[i] > kAlone * theirs[kFew / 4];
  });
  const auto is_known = [&](int64_t i) {
    for (const int32_t id : near_of(i)) {
      if (far[id]) continue;
      for (const int32_t back : near_of(id)) {
        if (back == i) return true;
      }
    }
    return false;
  };
  return rows_where(tree.size(), [&](int32_t i) { return far[i] && !is_known(i); });
}

namespace {

bool is_border(const PointTree& tree, int32_t place, double reach, std::vector<Neighbour>& near,
               std::vector<Vec3>& points) {
  points.clear();
  tree.visit([&](const Box& box) { return squared_distance(box, tree[place]) <= reach * reach; },
             [&](const Vec3& p) {
               if (distance(p, tree[place]) <= reach) points.push_back(p);
             });
  if (points.size() < kAround) {
    tree.find(tree[place], kAround, near);
    points.clear();
    for (const auto& [away, id] : near) points.push_back(tree[id]);
  }
  const auto [u, v] = across(least_spread(points));
  std::vector<double> angles;
  for (const Vec3& p : points) {
    const Vec3 away = p - tree[place];
    const double x = dot(away, u), y = dot(away, v);
    if (x != 0 || y != 0) angles.push_back(portable::atan2(y, x));
  }
  if (angles.empty()) return false;
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * std::numbers::pi - angles.back();
  for (size_t i = 1; i < angles.size(); ++i) {
    widest = std::max(widest, angles[i] - angles[i - 1]);
  }
  return widest > kEmpty;
}

}  // namespace

double border_share(const PointTree& tree, double reach, const Run& run) {
  const int64_t places = std::min<int64_t>(kLooked, tree.size());
  std::vector<uint8_t> borders(static_cast<size_t>(places), 0);
  parallel_chunks(
      places, run,
      [&](int64_t begin, int64_t end, int) {
        std::vector<Neighbour> near;
        std::vector<Vec3> points;
        for (int64_t i = begin; i < end; ++i) {
          const auto place = static_cast<int32_t>(i * tree.size() / places);
          borders[i] = is_border(tree, place, reach, near, points);
        }
      },
      64);
  return std::accumulate(borders.begin(), borders.end(), 0.0) / static_cast<double>(places);
}

}  // namespace medial
