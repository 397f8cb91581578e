// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/ball_places.h"

#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "base/rows.h"
#include "base/vec3.h"
#include "cover/pieces.h"

namespace medial {
namespace {

constexpr double kCoarser = 1.25;  // from cells that are too small to the next ones; chosen: balls

struct InCell {
  int64_t x, y, z;
  double rank;
  int32_t id;

  bool same_cell(const InCell& other) const {
    return std::tie(x, y, z) == std::tie(other.x, other.y, other.z);
  }
  bool operator<(const InCell& other) const {
    if (!same_cell(other)) return std::tie(x, y, z) < std::tie(other.x, other.y, other.z);
    return rank != other.rank ? rank > other.rank : id < other.id;
  }
};

}  // namespace

std::vector<BoundedPlace> bounded(std::span<const Vec3> places, std::span<const Ball> balls,
                                  const Run& run) {
  const NearestBall nearest(balls);
  std::vector<BoundedPlace> result(places.size());
  parallel_for(static_cast<int64_t>(places.size()), {run.threads}, [&](int64_t i) {
    result[i] = {places[i], gap(balls[nearest.find(places[i])], places[i])};
  });
  return result;
}

std::vector<int32_t> one_per_cell(std::span<const Vec3> points, std::span<const double> ranks,
                                  double cell) {
  const Box box = box_of(points);
  std::vector<InCell> all;
  all.reserve(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const auto at = [&](int axis) {
      const double along = coordinate(points[i], axis) - coordinate(box.low, axis);
      return static_cast<int64_t>(std::floor(along / cell));
    };
    all.push_back({at(0), at(1), at(2), ranks.empty() ? 0 : ranks[i], static_cast<int32_t>(i)});
  }
  std::sort(all.begin(), all.end());
  std::vector<int32_t> ids;
  for (size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || !all[i].same_cell(all[i - 1])) ids.push_back(all[i].id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<Vec3> surface_places(std::span<const Vec3> vertices, std::span<const Triangle> faces,
                                 double piece, const Run& run) {
  std::vector<Vec3> centres;
  for (const auto& [i, j, k] : faces) {
    visit_pieces(vertices[i], vertices[j], vertices[k], piece, run.progress,
                 [&](const Vec3& a, const Vec3& b, const Vec3& c) {
                   centres.push_back((1.0 / 3) * (a + b + c));
                 });
  }
  return rows_of(centres, one_per_cell(centres, {}, piece));
}

std::vector<Vec3> even_places(std::span<const Vec3> points, double cell, int64_t most) {
  for (;; cell *= kCoarser) {
    const auto ids = one_per_cell(points, {}, cell);
    if (static_cast<int64_t>(ids.size()) <= most) return rows_of(points, ids);
  }
}

}  // namespace medial
