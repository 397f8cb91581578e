// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/winding_number.h"

#include <algorithm>
#include <unordered_map>

#include "base/union_find.h"

namespace medial {

std::vector<Corners> soup(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    const Corners t{vertices[i], vertices[j], vertices[k]};
    if (t.a != t.b && t.b != t.c && t.c != t.a) corners.push_back(t);
  }
  return corners;
}

namespace {

// Returns the caps. Every connected part of the boundary is closed, so each gets an apex of its
// own, the mean of its edges.
std::vector<Corners> caps(std::span<const Vec3> vertices, std::span<const Edge> boundary) {
  if (boundary.empty()) return {};
  struct Apex {
    Vec3 sum;
    int edges = 0;
  };
  UnionFind parts(vertices.size());
  for (const auto& [from, to] : boundary) parts.unite(from, to);
  std::unordered_map<int32_t, Apex> apexes;
  for (const auto& [from, to] : boundary) {
    Apex& apex = apexes[parts.find(from)];
    apex.sum = apex.sum + 0.5 * (vertices[from] + vertices[to]);
    ++apex.edges;
  }
  std::vector<Corners> corners;
  for (const auto& [from, to] : boundary) {
    const Apex& apex = apexes[parts.find(from)];
    corners.push_back({vertices[to], vertices[from], (1.0 / apex.edges) * apex.sum});
  }
  return corners;
}

std::vector<Corners> joined(std::vector<Corners> a, const std::vector<Corners>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The directions are in general position with respect to axes and diagonals, where many models have
// edges.
constexpr Vec3 kDirections[] = {{0.4267, 0.3181, 0.8466},   {-0.5721, 0.7411, 0.3513},
                                {0.8123, -0.4877, -0.3199}, {-0.2591, -0.6737, 0.6921},
                                {0.1373, 0.9137, -0.3825},  {-0.9311, 0.0719, -0.3577}};

}  // namespace

WindingNumber::WindingNumber(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                             std::span<const Edge> boundary, const Progress* progress)
    : WindingNumber(soup(vertices, triangles), caps(vertices, boundary), progress) {}

WindingNumber::WindingNumber(std::vector<Corners> soup, std::vector<Corners> caps,
                             const Progress* progress)
    : crossings_(joined(std::move(soup), caps), progress), caps_(std::move(caps)) {}

int WindingNumber::closed(const Vec3& query) const {
  if (crossings_.is_beyond(query)) return 0;
  for (const Vec3& direction : kDirections) {
    if (const auto drop = crossings_(query, normalized(direction))) return *drop;
  }
  return static_cast<int>(std::lround(solid_angle_sum(crossings_.triangles(), query)));
}

int WindingNumber::closed_from(const Vec3& known, int closed_there, const Vec3& query) const {
  const Vec3 way = query - known;
  const double reach = length(way);
  if (reach == 0) return closed_there;
  if (crossings_.is_beyond(query)) return 0;
  const auto drop = crossings_(known, (1 / reach) * way, reach);
  return drop ? closed_there - *drop : closed(query);
}

// One ray serves all places. Where it meets edges, it may count triangles twice or not at all; then
// the count is wrong at the last place, and each place is computed by itself.
void WindingNumber::closed_along(const Vec3& first, double step, std::span<int> result) const {
  if (result.empty()) return;
  const auto place = [&](size_t i) { return first + Vec3{step * static_cast<double>(i), 0, 0}; };
  const Vec3 origin = first - Vec3{step, 0, 0};
  std::vector<RayCrossings::Hit> hits;
  crossings_.hits(origin, {1, 0, 0}, step * static_cast<double>(result.size()), hits);
  std::sort(hits.begin(), hits.end());
  int number = closed(origin);
  auto hit = hits.begin();
  for (size_t i = 0; i < result.size(); ++i) {
    const double at = step * static_cast<double>(i + 1);
    for (; hit != hits.end() && hit->at < at; ++hit) number += hit->cosine < 0 ? 1 : -1;
    result[i] = number;
  }
  if (number == closed(place(result.size() - 1))) return;
  for (size_t i = 0; i < result.size(); ++i) result[i] = closed(place(i));
}

double WindingNumber::operator()(const Vec3& query) const {
  return closed(query) - caps_.exact(query);
}

bool WindingNumber::is_inside(const Vec3& query, int closed_here) const {
  return caps_.is_below(closed_here - 0.5, query);
}

bool WindingNumber::is_inside_along(const Vec3& from, const Vec3& to) const {
  constexpr int kPlaces = 8;
  const Vec3 way = to - from;
  const double reach = length(way);
  const int closed_there = closed(from);
  if (reach == 0) return is_inside(from, closed_there);
  std::vector<RayCrossings::Hit> hits;
  crossings_.hits(from, (1 / reach) * way, reach, hits);
  std::vector<double> cuts;
  for (const auto& hit : hits) cuts.push_back(hit.at / reach);
  for (int i = 0; i <= kPlaces; ++i) cuts.push_back(i / double{kPlaces});
  std::sort(cuts.begin(), cuts.end());
  for (size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i - 1] == cuts[i]) continue;
    const Vec3 middle = from + 0.5 * (cuts[i - 1] + cuts[i]) * way;
    if (!is_inside(middle, closed_from(from, closed_there, middle))) return false;
  }
  return true;
}

}  // namespace medial
