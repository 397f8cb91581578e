// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/convex_creases.h"

#include <map>

#include "base/point_tree.h"
#include "base/rows.h"
#include "base/union_find.h"

namespace medial {
namespace {

constexpr double kBendsApart = 8;    // spacings between the bends of a meant line; chosen: axis
constexpr double kNearBend = 4;      // spacings from a zigzag to its straight edges; chosen: axis
constexpr double kLeastPatch = 100;  // squares of the spacing; chosen: axis, midsurface
constexpr double kLeastCrease = 12;  // spacings along creases that hang together; chosen: unseen
constexpr int kCreaseSteps = 16;

double area_of(const TriangleMesh& mesh, int32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return 0.5 * length(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
}

// Joins patches below an area to the neighbour with the longest common border, in one pass.
void join_small(const TriangleMesh& mesh, std::span<const MeshEdge> edges,
                std::span<const int32_t> creases, double least, std::vector<int32_t>& patch) {
  std::vector<double> area(patch.size(), 0);
  for (size_t t = 0; t < patch.size(); ++t)
    area[patch[t]] += area_of(mesh, static_cast<int32_t>(t));
  std::map<Edge, double> border;  // from a small patch to any other one
  for (const int32_t e : creases) {
    const int32_t a = patch[edges[e].triangles[0]], b = patch[edges[e].triangles[1]];
    const double size = distance(mesh.points[edges[e].ends[0]], mesh.points[edges[e].ends[1]]);
    if (a == b) continue;
    if (area[a] < least) border[{a, b}] += size;
    if (area[b] < least) border[{b, a}] += size;
  }
  std::map<int32_t, std::pair<double, int32_t>> longest;
  for (const auto& [pair, size] : border) {
    auto& best = longest[pair[0]];
    if (size > best.first) best = {size, pair[1]};
  }
  UnionFind joined(patch.size());
  for (const auto& [small, best] : longest) joined.unite(small, best.second);
  for (int32_t& p : patch) p = joined.find(p);
}

}  // namespace

ConvexCreases::ConvexCreases(const Faces& faces, double spacing)
    : faces_(faces),
      corner_(faces.mesh().points.size(), 0),
      divides_(faces.creases().edges.size(), 0),
      jagged_(faces.creases().edges.size(), 0),
      fragment_(faces.creases().edges.size(), 0) {
  const auto& edges = faces.creases().edges;
  segments_ = rows_where(edges.size(), [&](int32_t e) { return faces.is_convex_crease(e); });
  for (const int32_t e : segments_) {
    for (const int32_t end : edges[e].ends) corner_[end] = faces.creases().corner[end];
  }
  if (segments_.empty()) return;
  find_corners(find_patches(spacing), spacing);
  find_fragments(spacing);
  nodes_ = tree_of_boxes(segments_, [&](int32_t e) {
    Box around;
    for (const int32_t t : edges[e].triangles) {
      for (int i = 0; i <= 3; ++i) {
        around.add(
            faces.point(t, place_on_edge(faces.mesh().triangles[t], edges[e].ends, i / 3.0)));
      }
    }
    return around;
  });
}

// A bend that has another one close by is part of a zigzag, and so is an end or a meeting of
// creases there, unless three patches meet in it.
void ConvexCreases::find_corners(std::span<const int32_t> patch, double spacing) {
  const auto bends = rows_where(
      corner_.size(), [&](int32_t v) { return corner_[v] != 0 && !meets_three(v, patch); });
  const auto places = rows_of(faces_.mesh().points, bends);
  const PointTree tree = PointTree::sorted(places, {});
  std::vector<Neighbour> near;
  std::vector<Vec3> jagged;
  for (size_t i = 0; i < bends.size(); ++i) {
    tree.find(places[i], 2, near);
    if (near.size() < 2 || !(near[1].distance < kBendsApart * spacing)) continue;
    corner_[bends[i]] = 0;
    jagged.push_back(places[i]);
  }
  find_zigzags(jagged, spacing);
}

void ConvexCreases::find_zigzags(std::span<const Vec3> bends, double spacing) {
  if (bends.empty()) return;
  const PointTree tree = PointTree::sorted(bends, {});
  const auto& points = faces_.mesh().points;
  for (const int32_t e : segments_) {
    const auto& [a, b] = faces_.creases().edges[e].ends;
    for (const Vec3& place : {points[a], 0.5 * (points[a] + points[b]), points[b]}) {
      if (tree.has_within(place, kNearBend * spacing)) jagged_[e] = 1;
    }
  }
}

// On a coarse mesh of a smooth body single edges are sharp here and there. Sheets that reached for
// them would have teeth.
void ConvexCreases::find_fragments(double spacing) {
  const auto& points = faces_.mesh().points;
  const auto& edges = faces_.creases().edges;
  UnionFind joined(points.size());
  for (const int32_t e : segments_) joined.unite(edges[e].ends[0], edges[e].ends[1]);
  std::vector<double> size(points.size(), 0);
  std::vector<uint8_t> whole(points.size(), 0);
  for (const int32_t e : segments_) {
    const int32_t set = joined.find(edges[e].ends[0]);
    size[set] += distance(points[edges[e].ends[0]], points[edges[e].ends[1]]);
    whole[set] |= divides_[e];
  }
  for (const int32_t e : segments_) {
    const int32_t set = joined.find(edges[e].ends[0]);
    fragment_[e] = !whole[set] && size[set] < kLeastCrease * spacing;
  }
}

// Returns whether at least three patches meet in a vertex.
bool ConvexCreases::meets_three(int32_t vertex, std::span<const int32_t> patch) const {
  Edge found{-1, -1};
  for (const int32_t t : faces_.mesh().fans[vertex]) {
    if (patch[t] == found[0] || patch[t] == found[1]) continue;
    if (found[1] >= 0) return true;
    found[found[0] >= 0] = patch[t];
  }
  return false;
}

std::vector<int32_t> ConvexCreases::find_patches(double spacing) {
  const auto& mesh = faces_.mesh();
  const auto& edges = faces_.creases().edges;
  UnionFind patches(mesh.triangles.size());
  for (size_t e = 0; e < edges.size(); ++e) {
    if (!faces_.separates(static_cast<int32_t>(e))) {
      patches.unite(edges[e].triangles[0], edges[e].triangles[1]);
    }
  }
  const auto representatives = std::move(patches).representatives();
  std::vector<int32_t> patch(representatives.begin(), representatives.end());
  join_small(mesh, edges, segments_, kLeastPatch * spacing * spacing, patch);
  for (const int32_t e : segments_) {
    divides_[e] = patch[edges[e].triangles[0]] != patch[edges[e].triangles[1]];
  }
  return patch;
}

// Divides the chord and improves the place on the curved edge by secants.
PlaceOnCrease ConvexCreases::place_on(int32_t edge, const Vec3& from) const {
  const MeshEdge& e = faces_.creases().edges[edge];
  const int32_t t = e.triangles[0];
  const Triangle& corners = faces_.mesh().triangles[t];
  const auto point = [&](double share) {
    return faces_.point(t, place_on_edge(corners, e.ends, share));
  };
  const Vec3 first = faces_.mesh().points[e.ends[0]],
             chord = faces_.mesh().points[e.ends[1]] - first;
  const double squared = squared_length(chord);
  double share = squared > 0 ? std::clamp(dot(from - first, chord) / squared, 0.0, 1.0) : 0;
  Vec3 here = point(share);
  for (int i = 0; i < kCreaseSteps && squared > 0; ++i) {
    const double next = std::clamp(share + dot(from - here, chord) / squared, 0.0, 1.0);
    if (std::abs(next - share) < kRoundingShare) break;
    share = next;
    here = point(share);
  }
  return {edge, share, here, medial::distance(here, from)};
}

std::optional<PlaceOnCrease> ConvexCreases::nearer(const Vec3& from, double than) const {
  return nearest_place<PlaceOnCrease>(
      nodes_, segments_, than,
      [&](const BoxNode& node) { return squared_distance(node.box, from); },
      [&](int32_t edge, double) { return std::optional(place_on(edge, from)); });
}

}  // namespace medial
