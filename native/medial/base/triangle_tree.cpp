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
    triangles_.push_back({vertices[a], vertices[b], vertices[c]});
  }
  build(0, static_cast<int32_t>(triangles_.size()));
}

int32_t TriangleTree::build(int32_t begin, int32_t end) {
  const auto id = static_cast<int32_t>(nodes_.size());
  Node node{.begin = begin, .end = end};
  for (int32_t i = begin; i < end; ++i) {
    for (const Vec3& corner : {triangles_[i].a, triangles_[i].b, triangles_[i].c}) {
      node.box.add(corner);
    }
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafOfTree) return id;
  const int axis = longest_axis(node.box.extent());
  const int32_t middle = begin + (end - begin) / 2;
  const auto key = [axis](const Corners& t) {
    return coordinate(t.a, axis) + coordinate(t.b, axis) + coordinate(t.c, axis);
  };
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                   triangles_.begin() + end,
                   [&](const Corners& s, const Corners& t) { return key(s) < key(t); });
  build(begin, middle);
  const int32_t right = build(middle, end);
  nodes_[id].right = right;
  return id;
}

double TriangleTree::distance(const Vec3& query) const {
  double squared = HUGE_VAL;
  search(0, query, squared);
  return std::sqrt(squared);
}

void TriangleTree::search(int32_t id, const Vec3& query, double& squared) const {
  const Node& node = nodes_[id];
  // No triangle of the node is nearer than its box, up to rounding.
  if (medial::squared_distance(node.box, query) > squared) return;
  if (node.right < 0) {
    for (int32_t i = node.begin; i < node.end; ++i) {
      squared = std::min(squared, squared_distance(triangles_[i], query));
    }
    return;
  }
  int32_t near = id + 1, far = node.right;
  const auto away = [&](int32_t child) {
    return medial::squared_distance(nodes_[child].box, query);
  };
  if (away(far) < away(near)) std::swap(near, far);
  search(near, query, squared);
  search(far, query, squared);
}

// Measures to the plane if the query projects into the triangle, else to the nearest of its sides.
double TriangleTree::squared_distance(const Corners& triangle, const Vec3& query) {
  const auto& [a, b, c] = triangle;
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
