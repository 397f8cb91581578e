// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/opposite_walls.h"

#include <numeric>

#include "sampling/closest_on_flat.h"

namespace medial {
namespace {

constexpr int32_t kLeafOfWalls = 4;
constexpr int kMostShrinkings = 32;
constexpr double kFacing = 0.8660254037844386;  // the cosine of 30 degrees
constexpr double kUpright =
    0.94;  // the cosine between a normal and the way to the centre, at least
// A ball touches where it is not cut deeper than by this share of its radius.
constexpr double kTouching = 1e-9;
// Walls closer than this share of the reach meet there.
constexpr double kMeeting = 1e-8;

}  // namespace

OppositeWalls::OppositeWalls(const TriangleMesh& mesh)
    : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Box> boxes(order_.size());
  for (size_t t = 0; t < boxes.size(); ++t) {
    for (const int32_t corner : mesh.triangles[t]) boxes[t].add(mesh.points[corner]);
  }
  const auto describe = [&](Node& node) {
    for (int32_t i = node.begin; i < node.end; ++i) {
      node.box.add(boxes[order_[i]].low);
      node.box.add(boxes[order_[i]].high);
    }
  };
  const auto split = [&](const Node& node) {
    const int axis = longest_axis(node.box.extent());
    return split_in_middle(order_, node.begin, node.end, [&, axis](int32_t t) {
      return std::pair(coordinate(boxes[t].low, axis) + coordinate(boxes[t].high, axis), t);
    });
  };
  if (!order_.empty()) {
    build_tree(nodes_, 0, static_cast<int32_t>(order_.size()), kLeafOfWalls, describe, split);
  }
}

Vec3 OppositeWalls::point(int32_t triangle, const Barycentric& at) const {
  const auto& [p, q, r] = mesh_.triangles[triangle];
  const Vec3& origin = mesh_.points[p];
  return origin + at.b * (mesh_.points[q] - origin) + at.c * (mesh_.points[r] - origin);
}

// Returns the nearest place of the triangles that face a normal; of equally near ones that of the
// lowest triangle.
OppositeWalls::Touch OppositeWalls::nearest_facing(const Vec3& centre, const Vec3& normal,
                                                   double than) const {
  Touch best;
  double within = than * than;
  visit_nearest(
      nodes_, 0, [&](const Node& node) { return squared_distance(node.box, centre); },
      [&] { return within; },
      [&](const Node& leaf) {
        for (int32_t i = leaf.begin; i < leaf.end; ++i) {
          const int32_t t = order_[i];
          if (!(dot(mesh_.normal[t], normal) < -kFacing)) continue;
          const auto& [p, q, r] = mesh_.triangles[t];
          const Barycentric at =
              closest_on_flat(mesh_.points[p], mesh_.points[q], mesh_.points[r], centre);
          const Vec3 found = point(t, at);
          const double away = squared_length(found - centre);
          if (away < within || (away == within && best.triangle > t)) {
            best = {t, at, found};
            within = away;
          }
        }
      });
  return best;
}

// The ball shrinks to touch the place that lies deepest in it, until it holds none.
std::optional<WallPlace> OppositeWalls::operator()(const Vec3& from, const Vec3& normal,
                                                   double reach) const {
  double radius = 0.5 * reach;
  Touch touch;
  if (normal == Vec3{} || nodes_.empty()) return {};
  for (int i = 0; i < kMostShrinkings; ++i) {
    const Touch next = nearest_facing(from - radius * normal, normal, (1 - kTouching) * radius);
    if (next.triangle < 0) break;
    const Vec3 back = from - next.point;
    const double depth = dot(back, normal);
    if (!(depth > kMeeting * reach)) return {};
    radius = squared_length(back) / (2 * depth);
    touch = next;
  }
  if (touch.triangle < 0) return {};
  const Vec3 away = normalized(from - radius * normal - touch.point);
  if (!(-dot(away, mesh_.normal[touch.triangle]) > kUpright)) return {};
  return WallPlace{touch.triangle, touch.at, distance(from, touch.point)};
}

}  // namespace medial
