// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/creases.h"

#include <numbers>
#include <tuple>

#include "base/portable_math.h"
#include "base/rounding.h"
#include "base/rows.h"
#include "base/sort.h"
#include "inside/boundary.h"
#include "inside/surface.h"
#include "sampling/mitres.h"

namespace medial {
namespace {

// Coordinates come from float32, so heights below its rounding are meaningless.
constexpr double kRounding = 0x1p-22;  // derived: 2 bits above a float's 24

// Returns the point of each input row, or -1 for unused rows; fills points and row.
std::vector<int32_t> weld(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                          TriangleMesh& mesh) {
  std::vector<uint8_t> used(vertices.size(), 0);
  for (const Triangle& t : triangles) {
    for (const int32_t corner : t) used[corner] = 1;
  }
  auto order = rows_where(vertices.size(), [&](int32_t i) { return used[i] != 0; });
  const auto key = [&](int32_t i) {
    const Vec3& p = vertices[i];
    return std::tie(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(),
            [&](int32_t a, int32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<int32_t> point(vertices.size(), -1);  // at first the lowest equal row
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && vertices[order[i]] == vertices[order[i - 1]];
    point[order[i]] = same ? point[order[i - 1]] : order[i];
  }
  for (int32_t i = 0; i < static_cast<int32_t>(vertices.size()); ++i) {
    if (point[i] == i) {
      point[i] = static_cast<int32_t>(mesh.points.size());
      mesh.points.push_back(vertices[i]);
      mesh.row.push_back(i);
    } else if (point[i] >= 0) {
      point[i] = point[point[i]];
    }
  }
  return point;
}

// Adds the triangles. Those with a repeated corner have no area and are omitted; of triangles with
// the same corners the first one stays.
void add_triangles(std::span<const Triangle> triangles, std::span<const int32_t> point,
                   TriangleMesh& mesh, const Run& run) {
  std::vector<Triangle> sorted;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    const Triangle t{point[a], point[b], point[c]};
    if (!has_three_corners(t)) continue;
    mesh.triangles.push_back(t);
    mesh.source.push_back(static_cast<int32_t>(i));
    sorted.push_back(ascending(t));
  }
  const auto order =
      lexicographic_order(std::span<const Triangle>(sorted), mesh.points.size(), run);
  std::vector<uint8_t> again(sorted.size(), 0);
  for (size_t i = 1, first = 0; i < order.size(); ++i) {
    if (sorted[order[i]] != sorted[order[i - 1]]) first = i;
    if (first == i) continue;
    const auto [low, high] = std::minmax(order[first], order[i]);
    again[high] = 1;
    if (low != order[first]) first = i;
  }
  size_t kept = 0;
  for (size_t i = 0; i < again.size(); ++i) {
    if (again[i]) continue;
    mesh.triangles[kept] = mesh.triangles[i];
    mesh.source[kept++] = mesh.source[i];
  }
  mesh.triangles.resize(kept);
  mesh.source.resize(kept);
}

// Returns the corner opposite the longest edge.
int tip(const TriangleMesh& mesh, const Triangle& t) {
  std::array<double, 3> opposite;
  for (int i = 0; i < 3; ++i) {
    opposite[i] = squared_length(mesh.points[t[(i + 1) % 3]] - mesh.points[t[(i + 2) % 3]]);
  }
  return static_cast<int>(std::max_element(opposite.begin(), opposite.end()) - opposite.begin());
}

// Returns the lowest other triangle that has the edge in the opposite direction, or -1.
int32_t across(const TriangleMesh& mesh, int32_t triangle, int32_t p, int32_t q) {
  for (const int32_t other : mesh.fans[p]) {
    if (other == triangle) continue;
    if (link_of(mesh.triangles[other], p)[1] == q) return other;
  }
  return -1;
}

// Gives slivers thinner than rounding the normal of the triangle across their longest edge, so that
// their other two edges are as sharp as they would be without the sliver.
void borrow_normals(TriangleMesh& mesh, std::vector<int32_t> slivers) {
  if (slivers.empty()) return;
  const std::vector<Vec3> own = mesh.normal;
  for (const int32_t t : slivers) mesh.normal[t] = {};
  for (size_t before = slivers.size() + 1; !slivers.empty() && slivers.size() < before;) {
    before = slivers.size();
    std::erase_if(slivers, [&](int32_t t) {
      const Triangle& corners = mesh.triangles[t];
      const int i = tip(mesh, corners);
      const int32_t other = across(mesh, t, corners[(i + 1) % 3], corners[(i + 2) % 3]);
      if (other >= 0) mesh.normal[t] = mesh.normal[other];
      return mesh.normal[t] != Vec3{};
    });
  }
  for (const int32_t t : slivers) mesh.normal[t] = own[t];
}

void add_normals(TriangleMesh& mesh, const Run& run) {
  const double least = mesh.points.empty() ? 0 : kRounding * max_abs(box_of(mesh.points).extent());
  mesh.normal.resize(mesh.triangles.size());
  const auto slivers = parallel_append<int32_t>(
      static_cast<int64_t>(mesh.triangles.size()), run,
      [&](int64_t i, std::vector<int32_t>& out, int) {
        const Triangle& t = mesh.triangles[i];
        const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        const Vec3 doubled = cross(b - a, c - a);
        const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
        mesh.normal[i] = normalized(doubled);
        if (length(doubled) <= least * longest) out.push_back(static_cast<int32_t>(i));
      });
  borrow_normals(mesh, slivers);
}

Crease crease_of(const TriangleMesh& mesh, const MeshEdge& edge, size_t uses, double cosine) {
  if (uses == 1) return Crease::boundary;
  if (!edge.manifold) return Crease::sharp;
  const auto& [a, b] = edge.triangles;
  if (mesh.normal[a] == Vec3{} || mesh.normal[b] == Vec3{}) return Crease::none;
  return dot(mesh.normal[a], mesh.normal[b]) <= cosine ? Crease::sharp : Crease::none;
}

void add_edges(const TriangleMesh& mesh, double sharp_angle, Creases& creases, const Run& run) {
  const double cosine = portable::cos(std::max(0.0, sharp_angle - kAngleRounding));
  creases.edges = append_by_edge<MeshEdge>(
      mesh.triangles, mesh.fans, run,
      [&](int32_t p, std::span<const EdgeUse> uses, std::vector<MeshEdge>& out) {
        MeshEdge edge{{p, uses[0].other}, {uses[0].triangle, -1}};
        if (uses.size() > 1) edge.triangles[1] = uses[1].triangle;
        edge.manifold = uses.size() == 2 && uses[0].forward != uses[1].forward;
        edge.crease = crease_of(mesh, edge, uses.size(), cosine);
        out.push_back(edge);
      });
  creases.first_edge.assign(mesh.points.size() + 1, 0);
  for (const MeshEdge& edge : creases.edges) ++creases.first_edge[edge.ends[0]];
  counts_to_offsets(creases.first_edge);
}

bool straight(const TriangleMesh& mesh, int32_t before, int32_t at, int32_t after, double angle) {
  const Vec3 in = normalized(mesh.points[at] - mesh.points[before]);
  const Vec3 out = normalized(mesh.points[after] - mesh.points[at]);
  return portable::atan2(length(cross(in, out)), dot(in, out)) <= angle + kAngleRounding;
}

// Returns whether no crease ends here, but some triangle is steeper than the angle against the mean
// normal.
bool is_tip(const TriangleMesh& mesh, int32_t p, double angle) {
  const Vec3 mean = mesh.normal_sum(p);
  const double least = portable::cos(std::min(angle, std::numbers::pi / 2)) * length(mean);
  const auto steep = [&](int32_t t) {
    return mesh.normal[t] != Vec3{} && dot(mesh.normal[t], mean) < least;
  };
  return std::any_of(mesh.fans[p].begin(), mesh.fans[p].end(), steep);
}

void find_corners(const TriangleMesh& mesh, double angle, const Csr<int32_t>& at,
                  std::span<const int32_t> ids, Creases& creases, const Run& run) {
  creases.at.assign(mesh.points.size(), Crease::none);
  creases.corner.assign(mesh.points.size(), 0);
  parallel_for(static_cast<int64_t>(mesh.points.size()), run, [&](int64_t i) {
    const auto p = static_cast<int32_t>(i);
    const auto here = at[p];
    for (const int32_t id : here) {
      const Crease crease = creases.edges[ids[id]].crease;
      if (creases.at[i] != Crease::sharp) creases.at[i] = crease;
    }
    if (here.empty()) {
      creases.corner[i] = is_tip(mesh, p, angle);
    } else {
      creases.corner[i] =
          here.size() != 2 || !straight(mesh, other_end(creases.edges[ids[here[0]]], p), p,
                                        other_end(creases.edges[ids[here[1]]], p), angle);
    }
  });
}

// Follows the creases from `start` up to a stop, or back to the start.
void walk(const Creases& creases, const Csr<int32_t>& at, std::span<const int32_t> ids,
          std::span<const uint8_t> stop, int32_t start, int32_t crease,
          std::vector<uint8_t>& walked, Csr<ChainLink>& chains) {
  int32_t p = start;
  while (crease >= 0) {
    walked[crease] = 1;
    const MeshEdge& edge = creases.edges[ids[crease]];
    chains.items.push_back({ids[crease], edge.ends[1] == p});
    p = other_end(edge, p);
    crease = -1;
    if (stop[p] || p == start) break;
    for (const int32_t next : at[p]) {
      if (!walked[next]) crease = next;
    }
  }
  chains.offsets.push_back(static_cast<int64_t>(chains.items.size()));
}

void add_chains(const Csr<int32_t>& at, std::span<const int32_t> ids, std::span<const uint8_t> stop,
                Creases& creases) {
  creases.chains.offsets.assign(1, 0);
  std::vector<uint8_t> walked(ids.size(), 0);
  for (const bool from_stops : {true, false}) {
    for (int32_t p = 0; p < static_cast<int32_t>(stop.size()); ++p) {
      if (from_stops && !stop[p]) continue;
      for (const int32_t crease : at[p]) {
        if (!walked[crease]) walk(creases, at, ids, stop, p, crease, walked, creases.chains);
      }
    }
  }
}

}  // namespace

double TriangleMesh::corner_angle(int32_t triangle, int corner) const {
  const Triangle& t = triangles[triangle];
  const Vec3 u = points[t[(corner + 1) % 3]] - points[t[corner]];
  const Vec3 v = points[t[(corner + 2) % 3]] - points[t[corner]];
  return portable::atan2(length(cross(u, v)), dot(u, v));
}

Vec3 TriangleMesh::normal_sum(int32_t point) const {
  Vec3 sum;
  for (const int32_t t : fans[point]) {
    const auto& corners = triangles[t];
    const auto at = std::find(corners.begin(), corners.end(), point) - corners.begin();
    sum = sum + corner_angle(t, static_cast<int>(at)) * normal[t];
  }
  return sum;
}

int32_t Creases::find(int32_t p, int32_t q) const {
  if (p > q) std::swap(p, q);
  const auto begin = edges.begin() + first_edge[p], end = edges.begin() + first_edge[p + 1];
  const auto found = std::lower_bound(
      begin, end, q, [](const MeshEdge& edge, int32_t high) { return edge.ends[1] < high; });
  return found != end && found->ends[1] == q ? static_cast<int32_t>(found - edges.begin()) : -1;
}

TriangleMesh make_mesh(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                       const Run& run) {
  require_finite(vertices, "vertex");
  require_corners(triangles, vertices.size());
  TriangleMesh mesh;
  const auto point = weld(vertices, triangles, mesh);
  throw_if_cancelled(run.progress);
  add_triangles(triangles, point, mesh, run);
  mesh.fans = rows_containing(std::span<const Triangle>(mesh.triangles),
                              static_cast<int32_t>(mesh.points.size()), run);
  add_normals(mesh, run);
  mesh.rounding = rounding_of(mesh.points);
  return mesh;
}

std::vector<Edge> marked_edges(std::span<const Vec3> vertices, std::span<const Edge> rows,
                               const TriangleMesh& mesh, std::span<const Triangle> triangles) {
  std::vector<Edge> marked;
  if (rows.empty()) return marked;
  std::vector<int32_t> point(vertices.size(), -1);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) point[triangles[mesh.source[i]][k]] = mesh.triangles[i][k];
  }
  for (const auto& [p, q] : rows) {
    if (point[p] >= 0 && point[q] >= 0 && point[p] != point[q]) {
      marked.push_back({point[p], point[q]});
    }
  }
  return marked;
}

std::vector<std::array<int32_t, 3>> edges_of_triangles(const TriangleMesh& mesh,
                                                       const Creases& creases, const Run& run) {
  std::vector<std::array<int32_t, 3>> edges(mesh.triangles.size());
  parallel_for(static_cast<int64_t>(edges.size()), run, [&](int64_t t) {
    const Triangle& corners = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) edges[t][i] = creases.find(corners[i], corners[(i + 1) % 3]);
  });
  return edges;
}

std::vector<int32_t> crease_edges(const Creases& creases) {
  return rows_where(creases.edges.size(),
                    [&](int32_t e) { return creases.edges[e].crease != Crease::none; });
}

std::vector<int32_t> creases_at_points(const TriangleMesh& mesh, const Creases& creases) {
  std::vector<int32_t> count(mesh.points.size(), 0);
  for (const MeshEdge& edge : creases.edges) {
    for (const int32_t end : edge.ends) count[end] += edge.crease != Crease::none;
  }
  return count;
}

Creases find_creases(const TriangleMesh& mesh, double sharp_angle, std::span<const Edge> marked,
                     bool split_at_vertices, const Run& run) {
  Creases creases;
  creases.sharp_angle = sharp_angle;
  add_edges(mesh, sharp_angle, creases, run);
  mark_mitres(mesh, creases);
  for (const auto& [p, q] : marked) {
    const int32_t edge = creases.find(p, q);
    if (edge >= 0 && creases.edges[edge].crease == Crease::none) {
      creases.edges[edge].crease = Crease::sharp;
    }
  }
  const auto ids = crease_edges(creases);
  std::vector<Edge> ends;
  for (const int32_t id : ids) ends.push_back(creases.edges[id].ends);
  const auto at =
      rows_containing(std::span<const Edge>(ends), static_cast<int32_t>(mesh.points.size()));
  find_corners(mesh, sharp_angle, at, ids, creases, run);
  std::vector<uint8_t> stops = creases.corner;
  if (split_at_vertices) stops.assign(mesh.points.size(), 1);
  add_chains(at, ids, stops, creases);
  return creases;
}

}  // namespace medial
