// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/triangle_tree.h"

namespace medial {
namespace {

constexpr int32_t kLeafOfTree = 4;

double squared_distance_to_segment(const Vec3& a, const Vec3& b, const Vec3& query) {
  const Vec3 along = b - a, away = query - a;
  const double whole = squared_length(along);
  const double share = whole > 0 ? std::clamp(dot(away, along) / whole, 0.0, 1.0) : 0.0;
  return squared_length(away - share * along);
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  triangles_.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const auto row = static_cast<int32_t>(triangles_.size());
    triangles_.push_back({vertices[a], vertices[b], vertices[c], row});
  }
  const auto describe = [&](BoxNode& node) {
    for (int32_t i = node.begin; i < node.end; ++i) {
      for (const Vec3& corner : {triangles_[i].a, triangles_[i].b, triangles_[i].c}) {
        node.box.add(corner);
      }
    }
  };
  const auto split = [&](const BoxNode& node) {
    const int axis = longest_axis(node.box.extent());
    return split_in_middle(triangles_, node.begin, node.end, [axis](const Corners& t) {
      return coordinate(t.a, axis) + coordinate(t.b, axis) + coordinate(t.c, axis);
    });
  };
  build_tree(nodes_, 0, static_cast<int32_t>(triangles_.size()), kLeafOfTree, describe, split);
}

TriangleTree::Nearest TriangleTree::found(const Vec3& query) const {
  Nearest best;
  // No triangle of a node is nearer than its box, up to rounding.
  visit_nearest(
      nodes_, 0, [&](const BoxNode& node) { return medial::squared_distance(node.box, query); },
      [&] { return best.squared; },
      [&](const BoxNode& leaf) {
        for (int32_t i = leaf.begin; i < leaf.end; ++i) {
          best = std::min(best, {squared_distance(triangles_[i], query), triangles_[i].row});
        }
      });
  return best;
}

// Measures to the plane if the query projects into the triangle, else to the nearest of its sides.
double TriangleTree::squared_distance(const Corners& triangle, const Vec3& query) {
  const auto& [a, b, c, row] = triangle;
  const Vec3 normal = cross(b - a, c - a);
  const double area = squared_length(normal);
  const auto left_of = [&](const Vec3& p, const Vec3& q) {
    return dot(cross(q - p, query - p), normal) >= 0;
  };
  if (area > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a)) {
    const double height = dot(query - a, normal);
    return height * height / area;
  }
  return std::min({squared_distance_to_segment(a, b, query),
                   squared_distance_to_segment(b, c, query),
                   squared_distance_to_segment(c, a, query)});
}

}  // namespace medial
