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

class StraightVertices {
 public:
  StraightVertices(const SphereMesh& mesh, std::vector<FlatFace>& faces)
      : mesh_(mesh), faces_(faces), faces_at_(mesh.vertices.size()) {
    for (size_t f = 0; f < faces.size(); ++f) {
      for (const int32_t v : faces[f].corners) faces_at_[v].push_back(static_cast<int32_t>(f));
    }
    for (const Edge& wire : mesh.wires) {
      for (const int32_t v : wire) faces_at_[v].clear();
    }
  }

  // Takes the vertices out of the polygons, and returns a mark per vertex.
  std::vector<uint8_t> leave_out() {
    std::vector<uint8_t> marks(faces_at_.size(), 0);
    for (size_t v = 0; v < marks.size(); ++v) {
      if (!may_go(static_cast<int32_t>(v))) continue;
      marks[v] = 1;
      for (const int32_t f : faces_at_[v]) std::erase(faces_[f].corners, static_cast<int32_t>(v));
    }
    return marks;
  }

 private:
  // Returns the corners before and after a vertex of a polygon, the lower one first.
  Edge beside(int32_t face, int32_t v) const {
    const auto& corners = faces_[face].corners;
    const auto at = std::find(corners.begin(), corners.end(), v) - corners.begin();
    const auto count = static_cast<std::ptrdiff_t>(corners.size());
    const int32_t before = corners[(at + count - 1) % count], after = corners[(at + 1) % count];
    return {std::min(before, after), std::max(before, after)};
  }

  bool may_go(int32_t v) const {
    if (faces_at_[v].empty()) return false;
    const Edge ends = beside(faces_at_[v].front(), v);
    for (const int32_t f : faces_at_[v]) {
      if (faces_[f].corners.size() < 4 || beside(f, v) != ends) return false;
    }
    return is_straight(v, ends);
  }

  bool is_straight(int32_t v, const Edge& ends) const {
    const Vec3& start = mesh_.vertices[ends[0]];
    const Vec3 along = mesh_.vertices[ends[1]] - start, to = mesh_.vertices[v] - start;
    const double share = dot(to, along) / squared_length(along);
    const double radius = (1 - share) * mesh_.radius[ends[0]] + share * mesh_.radius[ends[1]];
    return share > 0 && share < 1 && length(to - share * along) <= kNoDistance &&
           std::abs(radius - mesh_.radius[v]) <= kNoDistance;
  }

  const SphereMesh& mesh_;
  std::vector<FlatFace>& faces_;
  std::vector<std::vector<int32_t>> faces_at_;  // none at a vertex of a wire
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

void leave_out_straight_vertices(SphereMesh& mesh, std::vector<FlatFace>& faces,
                                 std::vector<int32_t>& row) {
  const std::vector<uint8_t> left_out = StraightVertices(mesh, faces).leave_out();
  std::vector<int32_t> number(row.size(), -1);
  int32_t left = 0;
  for (size_t v = 0; v < row.size(); ++v) {
    if (left_out[v] != 0) continue;
    mesh.vertices[left] = mesh.vertices[v];
    mesh.radius[left] = mesh.radius[v];
    row[left] = row[v];
    number[v] = left++;
  }
  mesh.vertices.resize(left);
  mesh.radius.resize(left);
  row.resize(left);
  for (FlatFace& face : faces) {
    for (int32_t& v : face.corners) v = number[v];
  }
  for (Edge& wire : mesh.wires) wire = {number[wire[0]], number[wire[1]]};
}

}  // namespace medial
