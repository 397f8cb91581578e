// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh/target_length.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "base/parallel.h"
#include "base/rows.h"

namespace medial {
namespace {

// A place of a rim to which no vertex is nearest has the width of what is this many edges away.
constexpr int kRings = 8;

using Reached = std::pair<double, int32_t>;  // a value, and the vertex that has it

// Does the work of spread_least; calls found(vertex, from) for each vertex whose value is lowered
// by a neighbour, in the order of the values.
template <typename Found>
void spread(const SheetComplex& mesh, std::span<const Vec3> position, double slope,
            std::vector<double>& values, const Found& found) {
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (int32_t v = 0; v < mesh.vertices(); ++v) {
    if (mesh.has_triangles(v) && values[v] < HUGE_VAL) queue.emplace(values[v], v);
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
      queue.emplace(there, other);
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

// Turns of a sheet at the edges of a vertex, times half of their lengths: the sum, and the same
// with the edges' directions, doubled, in the plane across `normal`.
struct Turns {
  Vec3 normal;
  double area = 0;  // a third of the triangles at the vertex
  double sum = 0, along = 0, aslant = 0;

  void add(double turn, const Vec3& edge) {
    const auto [one, two] = across(normal);
    const double x = dot(edge, one), y = dot(edge, two), squared = x * x + y * y;
    if (!(squared > 0)) return;
    const double weight = 0.5 * turn * std::sqrt(squared);
    sum += weight;
    along += weight * (x * x - y * y) / squared;
    aslant += weight * 2 * x * y / squared;
  }
  double curvature() const {
    const double deviator = std::sqrt(along * along + aslant * aslant);
    return area > 0 ? 0.5 * (std::abs(sum) + deviator) / area : 0;
  }
};

// Returns the sine of the angle by which a sheet turns at the edge of two triangles, positive if it
// turns towards the normal of the first one.
double turn_at(const EvenMesh& even, const Edge& edge, int32_t one, int32_t other) {
  const int32_t a = edge[0], b = edge[1];
  const auto goes_forth = [&](int32_t t) {
    const Triangle& corners = even.mesh.triangle(t);
    return corners[(corner_of(corners, a) + 1) % 3] == b;
  };
  const double sign = goes_forth(one) == goes_forth(other) ? -1 : 1;
  const Vec3 turn = sign * cross(even.normal[one], even.normal[other]);
  const Vec3 along = even.position[b] - even.position[a];
  return std::copysign(length(turn), (goes_forth(one) ? 1 : -1) * dot(turn, along));
}

// Returns whether a vertex is inside a sheet or on its rim.
bool has_one_sheet(const SheetComplex& mesh, int32_t v) {
  return mesh.has_triangles(v) && (mesh.stratum(v) == Stratum::sheet || mesh.is_rim(v));
}

// Returns the turns of all vertices of one sheet, still without a turn.
std::vector<Turns> no_turns(const EvenMesh& even, const Run& run) {
  std::vector<Turns> found(even.position.size());
  parallel_for(even.mesh.vertices(), run, [&](int64_t id) {
    const auto v = static_cast<int32_t>(id);
    if (!has_one_sheet(even.mesh, v)) return;
    found[v].normal = normal_at(even, v);
    even.mesh.for_triangles(v, [&](int32_t t) {
      const auto& [a, b, c] = even.mesh.triangle(t);
      const auto& p = even.position;
      found[v].area += length(cross(p[b] - p[a], p[c] - p[a])) / 6;
    });
  });
  return found;
}

}  // namespace

std::vector<double> curvatures(const EvenMesh& even, const Run& run) {
  std::vector<Turns> at = no_turns(even, run);
  for (const Edge& edge : even.mesh.edges()) {
    const auto& two = even.mesh.triangles_at(edge[0], edge[1]);
    if (two.size() != 2) continue;
    const double turn = turn_at(even, edge, two[0], two[1]);
    const Vec3 along = even.position[edge[1]] - even.position[edge[0]];
    for (const int32_t v : edge) {
      at[v].add(std::copysign(1, dot(even.normal[two[0]], at[v].normal)) * turn, along);
    }
  }
  std::vector<double> found;
  for (const Turns& turns : at) found.push_back(turns.curvature());
  return found;
}

void spread_least(const SheetComplex& mesh, std::span<const Vec3> position, double slope,
                  std::vector<double>& values) {
  spread(mesh, position, slope, values, [](int32_t, int32_t) {});
}

std::vector<double> half_widths(const SheetComplex& mesh, std::span<const Vec3> position) {
  std::vector<double> distance(position.size(), HUGE_VAL);
  std::vector<int32_t> before(position.size(), -1);
  for (int32_t v = 0; v < mesh.vertices(); ++v) {
    if (mesh.stratum(v) != Stratum::sheet) distance[v] = 0;
  }
  auto order = rows_where(mesh.vertices(), [&](int32_t v) { return mesh.has_triangles(v); });
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
