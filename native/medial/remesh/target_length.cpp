// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh/target_length.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace medial {
namespace {

// A place of a rim to which no vertex is nearest has the width of what is this many edges away.
constexpr int kRings = 8;

struct Reached {
  double value;
  int32_t vertex;
  bool operator>(const Reached& other) const {
    return std::tie(value, vertex) > std::tie(other.value, other.vertex);
  }
};

// Does the work of spread_least; calls found(vertex, from) for each vertex whose value is lowered
// by a neighbour, in the order of the values.
template <typename Found>
void spread(const SheetComplex& mesh, std::span<const Vec3> position, double slope,
            std::vector<double>& values, const Found& found) {
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (int32_t v = 0; v < mesh.vertices(); ++v) {
    if (mesh.has_triangles(v) && values[v] < HUGE_VAL) queue.push({values[v], v});
  }
  while (!queue.empty()) {
    const auto [value, v] = queue.top();
    queue.pop();
    if (value > values[v]) continue;
    mesh.for_corners(v, [&, at = v, from = value](int32_t other) {
      const double there = from + slope * distance(position[at], position[other]);
      if (!(there < values[other])) return;
      values[other] = there;
      found(other, at);
      queue.push({there, other});
    });
  }
}

// Raises the values of vertices to the largest one next to them.
void raise_to_neighbours(const SheetComplex& mesh, std::vector<double>& values) {
  std::vector<double> raised(values);
  for (int32_t v = 0; v < mesh.vertices(); ++v) {
    mesh.for_corners(v, [&](int32_t other) { raised[v] = std::max(raised[v], values[other]); });
  }
  values = std::move(raised);
}

}  // namespace

void spread_least(const SheetComplex& mesh, std::span<const Vec3> position, double slope,
                  std::vector<double>& values) {
  spread(mesh, position, slope, values, [](int32_t, int32_t) {});
}

std::vector<double> half_widths(const SheetComplex& mesh, std::span<const Vec3> position) {
  std::vector<double> distance(position.size(), HUGE_VAL);
  std::vector<int32_t> before(position.size(), -1), order;
  for (int32_t v = 0; v < mesh.vertices(); ++v) {
    if (mesh.stratum(v) != Stratum::sheet) distance[v] = 0;
    if (mesh.has_triangles(v)) order.push_back(v);
  }
  spread(mesh, position, 1, distance, [&](int32_t v, int32_t from) { before[v] = from; });
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return std::tie(distance[a], a) < std::tie(distance[b], b);
  });
  // The farthest vertices tell those on the way to the rim how far they are, and these tell it on.
  std::vector<double> width(distance);
  for (auto v = order.rbegin(); v != order.rend(); ++v) {
    if (before[*v] >= 0) width[before[*v]] = std::max(width[before[*v]], width[*v]);
  }
  for (const int32_t v : order) {
    if (before[v] >= 0) width[v] = width[before[v]];
  }
  for (int ring = 0; ring < kRings; ++ring) raise_to_neighbours(mesh, width);
  return width;
}

}  // namespace medial
