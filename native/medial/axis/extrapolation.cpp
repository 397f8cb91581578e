// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/extrapolation.h"

#include <queue>

namespace medial {
namespace {

// An edge of the surface has the circumcircle of a triangle of the umbrellas at both of its ends.
bool follows_surface(const Edge& ends, std::span<const Vec3> points, const Tangents& tangents,
                     const Significance& significance) {
  const auto& [p, q] = ends;
  if (dot(tangents.normals[p], tangents.normals[q]) <= kWallCosine) return false;
  const double widest = 2 * std::min(significance.spacing[p], significance.spacing[q]);
  return distance(points[p], points[q]) <= widest;
}

// The edges that follow the surface and have an end whose value is wanted.
std::vector<Edge> paths(const std::vector<double>& values, std::span<const Vec3> points,
                        const Tangents& tangents, const Edges& edges,
                        const Significance& significance, const Run& run) {
  return parallel_append<Edge>(edges.count(), run, [&](int64_t e, std::vector<Edge>& kept, int) {
    const Edge& ends = edges.ends[e];
    if (values[ends[0]] < HUGE_VAL && values[ends[1]] < HUGE_VAL) return;
    if (follows_surface(ends, points, tangents, significance)) kept.push_back(ends);
  });
}

// A way from a sample with a value to another one.
struct Way {
  double length;
  int32_t to;
  double value;

  // Shortest first; of equally short ones, that to the lowest sample and with the lowest value.
  friend bool operator<(const Way& a, const Way& b) {
    return std::tie(a.length, a.to, a.value) > std::tie(b.length, b.to, b.value);
  }
};

}  // namespace

void extrapolate(std::vector<double>& values, std::span<const Vec3> points,
                 const Tangents& tangents, const Edges& edges, const Significance& significance,
                 const Run& run) {
  const auto ends = paths(values, points, tangents, edges, significance, run);
  const auto at = rows_containing(std::span<const Edge>(ends), static_cast<int32_t>(values.size()),
                                  {run.threads});
  std::vector<double> length(values.size(), HUGE_VAL);
  std::priority_queue<Way> ways;
  const auto go_on = [&](int32_t p) {
    for (const int32_t e : at[p]) {
      const int32_t q = ends[e][0] == p ? ends[e][1] : ends[e][0];
      const double way = length[p] + distance(points[p], points[q]);
      if (way < length[q]) ways.push({length[q] = way, q, values[p]});
    }
  };
  std::vector<int32_t> known;
  for (size_t p = 0; p < values.size(); ++p) {
    if (values[p] < HUGE_VAL) length[p] = 0, known.push_back(static_cast<int32_t>(p));
  }
  for (const int32_t p : known) go_on(p);
  while (!ways.empty()) {
    const Way way = ways.top();
    ways.pop();
    if (values[way.to] < HUGE_VAL) continue;  // a shorter way came before
    throw_if_cancelled(run.progress);
    values[way.to] = way.value;
    go_on(way.to);
  }
}

}  // namespace medial
