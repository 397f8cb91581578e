// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/crease_lines.h"

namespace medial {

CreaseLines::CreaseLines(const TriangleMesh& mesh, const Creases& creases)
    : mesh_(mesh), creases_(creases), order_(crease_edges(creases)) {
  const auto ends = [&](int32_t e) -> std::array<Vec3, 2> {
    return {mesh.points[creases.edges[e].ends[0]], mesh.points[creases.edges[e].ends[1]]};
  };
  const auto describe = [&](Node& node) {
    for (int32_t i = node.begin; i < node.end; ++i) {
      for (const Vec3& end : ends(order_[i])) node.box.add(end);
    }
  };
  const auto split = [&](const Node& node) {
    const int axis = longest_axis(node.box.extent());
    return split_in_middle(order_, node.begin, node.end, [&, axis](int32_t e) {
      const auto [p, q] = ends(e);
      return std::pair(coordinate(p, axis) + coordinate(q, axis), e);
    });
  };
  constexpr int32_t kInLeaf = 4;
  if (!order_.empty()) {
    build_tree(nodes_, 0, static_cast<int32_t>(order_.size()), kInLeaf, describe, split);
  }
}

PlaceOnLine CreaseLines::place_on(int32_t edge, const Vec3& from) const {
  const Edge& ends = creases_.edges[edge].ends;
  const Vec3 &p = mesh_.points[ends[0]], &q = mesh_.points[ends[1]];
  const double whole = squared_length(q - p);
  const double share = whole > 0 ? std::clamp(dot(from - p, q - p) / whole, 0.0, 1.0) : 0;
  return {edge, share, distance(from, p + share * (q - p))};
}

std::optional<PlaceOnLine> CreaseLines::nearest(const Vec3& from, double within) const {
  PlaceOnLine best;
  best.distance = within;
  if (nodes_.empty()) return {};
  visit_nearest(
      nodes_, 0, [&](const Node& node) { return squared_distance(node.box, from); },
      [&] { return best.distance * best.distance; },
      [&](const Node& leaf) {
        for (int32_t i = leaf.begin; i < leaf.end; ++i) {
          const PlaceOnLine found = place_on(order_[i], from);
          if (found.distance < best.distance ||
              (found.distance == best.distance && (best.edge < 0 || found.edge < best.edge))) {
            best = found;
          }
        }
      });
  if (best.edge < 0) return {};
  return best;
}

}  // namespace medial
