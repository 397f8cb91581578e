// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/flat_faces.h"

#include <algorithm>
#include <map>

#include "base/rows.h"
#include "base/union_find.h"
#include "base/vec3.h"
#include "reduce/sheet_locks.h"

namespace medial {
namespace {

// An edge between exactly two triangles, which are of one sheet.
struct InnerEdge {
  Edge ends;
  std::array<int32_t, 2> triangles;
};

double twice_area(const SphereMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.vertices[t[0]];
  return length(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
}

std::vector<InnerEdge> inner_edges(const SphereMesh& mesh, const std::vector<int32_t>& part) {
  std::map<Edge, std::vector<int32_t>> at;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    for (const Edge& e : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      at[{std::min(e[0], e[1]), std::max(e[0], e[1])}].push_back(static_cast<int32_t>(t));
    }
  }
  std::vector<InnerEdge> inner;
  for (const auto& [ends, those] : at) {
    if (those.size() != 2 || part[those[0]] != part[those[1]]) continue;
    inner.push_back({ends, {those[0], those[1]}});
  }
  return inner;
}

// The plane of a triangle, and the linear function that its radii are.
class Flat {
 public:
  Flat(const SphereMesh& mesh, const Triangle& t)
      : mesh_(mesh), at_(mesh.vertices[t[0]]), radius_(mesh.radius[t[0]]) {
    const Vec3 u = mesh.vertices[t[1]] - at_, v = mesh.vertices[t[2]] - at_;
    const Vec3 n = cross(u, v);
    const double area = squared_length(n);
    if (!(area > 0)) return;
    normal_ = (1 / std::sqrt(area)) * n;
    slope_ = (1 / area) * ((mesh.radius[t[1]] - radius_) * cross(v, n) +
                           (mesh.radius[t[2]] - radius_) * cross(n, u));
    exists_ = true;
  }

  bool holds(const Triangle& t) const {
    return exists_ && std::all_of(t.begin(), t.end(), [&](int32_t v) {
             const Vec3 to = mesh_.vertices[v] - at_;
             return std::abs(dot(to, normal_)) <= kNoDistance &&
                    std::abs(radius_ + dot(to, slope_) - mesh_.radius[v]) <= kNoDistance;
           });
  }

 private:
  const SphereMesh& mesh_;
  Vec3 at_, normal_{}, slope_{};
  double radius_;
  bool exists_ = false;
};

// Returns a number of the plane of each triangle. The largest triangle that has none yet gives its
// own to those that are connected with it in its plane.
std::vector<int32_t> planes_of(const SphereMesh& mesh, const std::vector<InnerEdge>& inner) {
  const auto count = mesh.triangles.size();
  std::vector<std::vector<int32_t>> beside(count);
  for (const InnerEdge& edge : inner) {
    beside[edge.triangles[0]].push_back(edge.triangles[1]);
    beside[edge.triangles[1]].push_back(edge.triangles[0]);
  }
  std::vector<double> area(count);
  std::vector<int32_t> order = all_rows(count), plane(count, -1);
  for (size_t t = 0; t < count; ++t) area[t] = twice_area(mesh, mesh.triangles[t]);
  std::stable_sort(order.begin(), order.end(),
                   [&](int32_t a, int32_t b) { return area[a] > area[b]; });
  for (const int32_t first : order) {
    if (plane[first] >= 0) continue;
    const Flat flat(mesh, mesh.triangles[first]);
    std::vector<int32_t> waiting{first};
    plane[first] = first;
    while (!waiting.empty()) {
      const int32_t t = waiting.back();
      waiting.pop_back();
      for (const int32_t other : beside[t]) {
        if (plane[other] >= 0 || !flat.holds(mesh.triangles[other])) continue;
        plane[other] = first;
        waiting.push_back(other);
      }
    }
  }
  return plane;
}

class Joiner {
 public:
  explicit Joiner(const SphereMesh& mesh) : sets_(mesh.triangles.size()) {
    for (const Triangle& t : mesh.triangles) loops_.emplace_back(t.begin(), t.end());
  }

  // Joins the polygons at an edge, if they have nothing else in common.
  void join(const InnerEdge& edge) {
    const int32_t one = sets_.find(edge.triangles[0]), two = sets_.find(edge.triangles[1]);
    if (one == two || common(loops_[one], loops_[two]) != 2) return;
    auto first = opened(loops_[one], edge.ends), second = opened(loops_[two], edge.ends);
    if (first.front() == second.front()) std::reverse(second.begin(), second.end());
    first.insert(first.end(), second.begin() + 1, second.end() - 1);
    loops_[one].clear();
    loops_[two].clear();
    sets_.unite(one, two);
    loops_[sets_.find(one)] = std::move(first);
  }

  // The corners of the polygon that a triangle stands for; none if it is part of another.
  const std::vector<int32_t>& loop(size_t triangle) const { return loops_[triangle]; }

 private:
  static int common(std::vector<int32_t> one, std::vector<int32_t> two) {
    std::sort(one.begin(), one.end());
    std::sort(two.begin(), two.end());
    std::vector<int32_t> both;
    std::set_intersection(one.begin(), one.end(), two.begin(), two.end(), std::back_inserter(both));
    return static_cast<int>(both.size());
  }

  // Turns a loop so that an edge of it goes from its last corner to its first one.
  static std::vector<int32_t> opened(std::vector<int32_t> loop, const Edge& ends) {
    const auto is_end = [&](int32_t v) { return v == ends[0] || v == ends[1]; };
    while (!is_end(loop.front()) || !is_end(loop.back())) {
      std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
    return loop;
  }

  UnionFind sets_;
  std::vector<std::vector<int32_t>> loops_;
};

}  // namespace

std::vector<FlatFace> flat_faces(const SphereMesh& mesh, const std::vector<int32_t>& part) {
  const auto inner = inner_edges(mesh, part);
  const auto plane = planes_of(mesh, inner);
  Joiner joiner(mesh);
  for (const InnerEdge& edge : inner) {
    if (plane[edge.triangles[0]] == plane[edge.triangles[1]]) joiner.join(edge);
  }
  std::vector<FlatFace> faces;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!joiner.loop(t).empty()) faces.push_back({part[t], joiner.loop(t)});
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const FlatFace& a, const FlatFace& b) { return a.part < b.part; });
  return faces;
}

}  // namespace medial
