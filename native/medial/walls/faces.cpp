// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/faces.h"

#include "base/rounding.h"
#include "base/rows.h"
#include "base/union_find.h"
#include "walls/closest_place.h"
#include "walls/least_distance.h"

namespace medial {
namespace {

constexpr int kMostWalked = 1 << 12;  // triangles of one walk
constexpr int32_t kLeafOfTree = 2;
constexpr size_t kFew = 8;  // triangles whose box holds their control points

// How exactly the vertices are known does not depend on the frame.
TriangleMesh mesh_in(const Frame& frame, const FacesInput& input, const Run& run) {
  if (frame.is_plain()) return make_mesh(input.vertices, input.triangles, run);
  TriangleMesh mesh = make_mesh(frame.inward(input.vertices), input.triangles, run);
  mesh.rounding = frame.inward(rounding_of(rows_of(input.vertices, mesh.row)));
  return mesh;
}

float rounded_up(double value) { return std::nextafter(static_cast<float>(value), HUGE_VALF); }

}  // namespace

Faces::Faces(const FacesInput& input, const Frame& frame, const Run& run, VertexNormals normals)
    : mesh_(mesh_in(frame, input, run)),
      creases_(find_creases(mesh_, input.sharp_angle,
                            marked_edges(input.vertices, input.sharp_edges, mesh_, input.triangles),
                            false, run)),
      triangle_of_(input.triangles.size(), -1) {
  surface_.emplace(mesh_, creases_, input.smooth, run, normals);
  for (size_t t = 0; t < mesh_.source.size(); ++t) {
    triangle_of_[mesh_.source[t]] = static_cast<int32_t>(t);
  }
  separates_.reserve(creases_.edges.size());
  for (const MeshEdge& edge : creases_.edges) separates_.push_back(separation(edge));
  edge_of_ = edges_of_triangles(mesh_, creases_, run);
  find_fans();
  if (input.smooth) {
    bulge_.resize(mesh_.triangles.size());
    parallel_for(static_cast<int64_t>(bulge_.size()), run, [&](int64_t id) {
      const auto t = static_cast<int32_t>(id);
      const Patch patch = surface_->patch(t);
      const double bulge = patch.bulge();
      // Only rounding bent a patch that bulges by less.
      if (!(bulge > kRoundingShare * max_abs(patch.box().extent()))) return;
      bulge_[t] = {rounded_up(bulge), rounded_up(patch.bulge(mesh_.normal[t]))};
    });
  }
  build_tree_of_faces();
}

size_t Faces::bytes() const {
  const auto size_of = [](const auto&... arrays) {
    return (... + (arrays.size() * sizeof(arrays[0])));
  };
  return size_of(mesh_.points, mesh_.row, mesh_.triangles, mesh_.source, mesh_.normal,
                 mesh_.fans.items, mesh_.fans.offsets, creases_.edges, creases_.first_edge,
                 creases_.at, creases_.corner, triangle_of_, edge_of_, separates_, fan_of_, bulge_,
                 order_, nodes_) +
         surface_->bytes();
}

uint8_t Faces::separation(const MeshEdge& edge) const {
  if (edge.crease == Crease::boundary || !edge.manifold) return 1;
  if (edge.crease == Crease::none) return 0;
  const auto& [s, t] = edge.triangles;
  const Triangle& other = mesh_.triangles[t];
  const int32_t third = other[0] + other[1] + other[2] - edge.ends[0] - edge.ends[1];
  const Vec3 away = mesh_.points[third] - mesh_.points[edge.ends[0]];
  return dot(mesh_.normal[s], away) < 0 ? kConvex : 0;
}

void Faces::find_fans() {
  UnionFind corners(3 * mesh_.triangles.size());
  for (size_t e = 0; e < creases_.edges.size(); ++e) {
    if (separates_[e]) continue;
    const auto& [s, t] = creases_.edges[e].triangles;
    for (const int32_t end : creases_.edges[e].ends) {
      corners.unite(3 * s + corner_of(mesh_.triangles[s], end),
                    3 * t + corner_of(mesh_.triangles[t], end));
    }
  }
  const auto fan = std::move(corners).representatives();
  fan_of_.resize(mesh_.triangles.size());
  for (size_t c = 0; c < fan.size(); ++c) fan_of_[c / 3][c % 3] = fan[c];
}

void Faces::build_tree_of_faces() {
  order_ = all_rows(mesh_.triangles.size());
  std::vector<Vec3> controls;
  const auto describe = [&](Node& node) {
    node.box = box_round({order_.data() + node.begin, order_.data() + node.end}, controls);
  };
  const auto split = [&](const Node& node) {
    const auto key = [&, axis = node.box.longest_axis()](int32_t t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      return std::pair(dot(axis, mesh_.points[a] + mesh_.points[b] + mesh_.points[c]), t);
    };
    return split_in_middle(order_, node.begin, node.end, key);
  };
  build_tree(nodes_, 0, static_cast<int32_t>(order_.size()), kLeafOfTree, describe, split);
}

// Returns a box that lies flat on some triangles. It holds the control points of a few, and the
// corners of many with room for the largest bulge. The memory of `controls` is used again.
OrientedBox Faces::box_round(std::span<const int32_t> triangles,
                             std::vector<Vec3>& controls) const {
  const bool few = triangles.size() <= kFew;
  Vec3 normal;
  double bulge = 0;
  controls.clear();
  for (const int32_t t : triangles) {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Vec3 &p = mesh_.points[a], &q = mesh_.points[b], &r = mesh_.points[c];
    normal = normal + cross(q - p, r - p);
    if (few) {
      const Patch patch = surface_->patch(t);
      controls.insert(controls.end(), patch.controls().begin(), patch.controls().end());
    } else {
      controls.insert(controls.end(), {p, q, r});
      if (is_curved(t)) bulge = std::max<double>(bulge, bulge_[t].most);
    }
  }
  OrientedBox box = oriented_box(normal, controls);
  for (double& half : box.half) half += bulge;
  return box;
}

Vec3 Faces::normal_of_patch(int32_t triangle, const Barycentric& at) const {
  if (!is_curved(triangle)) return normal(triangle, at);
  const PatchExpansion of = surface_->patch(triangle).polynomial({}).expansion(at.b, at.c);
  return normalized(cross(of.b, of.c));
}

Vec3 Faces::point(int32_t triangle, const Barycentric& at) const {
  return surface_->point(triangle, at);
}

Foot Faces::foot_on(int32_t triangle, const Vec3& from) const {
  const Foot flat = flat_foot(triangle, from);
  if (!is_curved(triangle)) return flat;
  return foot_on_patch(surface_->patch(triangle), triangle, flat.at, from);
}

Foot Faces::flat_foot(int32_t triangle, const Vec3& from) const {
  const Triangle& t = mesh_.triangles[triangle];
  const Vec3 &p = mesh_.points[t[0]], &q = mesh_.points[t[1]], &r = mesh_.points[t[2]];
  Foot foot{triangle, closest_on_flat(p, q, r, from), {}, 0};
  foot.point = p + foot.at.b * (q - p) + foot.at.c * (r - p);
  // The height over the plane has a smaller error than the difference of two places.
  const bool inside = foot.at.a > 0 && foot.at.b > 0 && foot.at.c > 0;
  foot.distance = inside && mesh_.normal[triangle] != Vec3{}
                      ? std::abs(dot(from - p, mesh_.normal[triangle]))
                      : medial::distance(from, foot.point);
  return foot;
}

Foot Faces::lifted(const Foot& flat, const Vec3& from) const {
  const Vec3 point = surface_->patch(flat.triangle).point(flat.at);
  return {flat.triangle, flat.at, point, medial::distance(from, point)};
}

std::vector<int32_t> Faces::places_in_tree() const { return places_among(order_, order_.size()); }

Foot Faces::foot_on_patch(const Patch& patch, int32_t triangle, const Barycentric& start,
                          const Vec3& from) {
  const Barycentric at = closest_on_patch(patch, start, from);
  const Vec3 point = patch.point(at);
  return {triangle, at, point, medial::distance(from, point)};
}

bool Faces::is_at_end(const Foot& foot) const {
  const double coordinates[3] = {foot.at.a, foot.at.b, foot.at.c};
  for (int i = 0; i < 3; ++i) {
    if (coordinates[i] == 0 && separates_[edge_of_[foot.triangle][(i + 1) % 3]]) return true;
  }
  return false;
}

Foot Faces::descend_again(const Foot& before, const Vec3& from) const {
  if (!is_curved(before.triangle)) return descend(before.triangle, from);
  const Patch patch = surface_->patch(before.triangle);
  return descend(foot_on_patch(patch, before.triangle, before.at, from), from);
}

Foot Faces::descend(Foot foot, const Vec3& from) const {
  for (int i = 0; i < kMostWalked; ++i) {
    const Foot next = best_neighbour(foot, from);
    if (!(next.distance < foot.distance)) break;
    foot = next;
  }
  return foot;
}

// Returns the nearest foot, or the given one, on the triangles that meet where a foot is, in the
// same wall.
template <typename FootOn>
Foot Faces::nearest_beside(const Foot& foot, const FootOn& foot_on_triangle) const {
  const double coordinates[3] = {foot.at.a, foot.at.b, foot.at.c};
  Foot best = foot;
  const auto take = [&](int32_t other) {
    const Foot found = foot_on_triangle(other);
    if (found.distance < best.distance) best = found;
  };
  for (int i = 0; i < 3; ++i) {
    if (coordinates[i] == 1) {
      const int32_t vertex = mesh_.triangles[foot.triangle][i], fan = fan_of_[foot.triangle][i];
      for (const int32_t t : mesh_.fans[vertex]) {
        if (t != foot.triangle && fan_of_[t][corner_of(mesh_.triangles[t], vertex)] == fan) take(t);
      }
      return best;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const int32_t edge = edge_of_[foot.triangle][(i + 1) % 3];  // opposite to corner i
    if (coordinates[i] != 0 || separates_[edge]) continue;
    const Edge& sides = creases_.edges[edge].triangles;
    take(sides[sides[0] == foot.triangle]);
  }
  return best;
}

Foot Faces::best_neighbour(const Foot& foot, const Vec3& from) const {
  return nearest_beside(foot, [&](int32_t triangle) { return foot_on(triangle, from); });
}

Foot Faces::lifted_beside(const Foot& foot, const Vec3& from) const {
  return nearest_beside(foot, [&](int32_t triangle) { return lifted(triangle, from); });
}

std::optional<Foot> Faces::nearer(const Vec3& from, double than) const {
  searches_.fetch_add(1, std::memory_order_relaxed);
  return nearest_place<Foot>(
      nodes_, order_, than,
      [&](const Node& node) { return medial::squared_distance(node.box, from); },
      [&](int32_t triangle, double within) { return foot_within(triangle, from, within); });
}

// Returns the foot on a triangle, or nothing if it is certain that none is nearer than a distance.
std::optional<Foot> Faces::foot_within(int32_t triangle, const Vec3& from, double within) const {
  if (!is_curved(triangle)) return foot_on(triangle, from);
  const Vec3& corner = mesh_.points[mesh_.triangles[triangle][0]];
  const bool is_inside = dot(from - corner, mesh_.normal[triangle]) < 0;
  const double room = is_inside ? bulge_[triangle].inwards : bulge_[triangle].most;
  if (flat_foot(triangle, from).distance - room > within) return {};
  const Patch patch = surface_->patch(triangle);
  if (least_squared_distance(patch, from) >= within * within) return {};
  const auto corners = patch.controls();
  return foot_on_patch(patch, triangle, closest_on_flat(corners[0], corners[1], corners[2], from),
                       from);
}

}  // namespace medial
