// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/crease_lines.h"

namespace medial {

CreaseLines::CreaseLines(const TriangleMesh& mesh, const Creases& creases)
    : mesh_(mesh), creases_(creases), order_(crease_edges(creases)) {
  nodes_ = tree_of_boxes(order_, [&](int32_t e) {
    Box box;
    for (const int32_t end : creases.edges[e].ends) box.add(mesh.points[end]);
    return box;
  });
}

std::optional<PlaceOnLine> CreaseLines::place_on(int32_t edge, const Vec3& from) const {
  const Edge& ends = creases_.edges[edge].ends;
  const Vec3 &p = mesh_.points[ends[0]], &q = mesh_.points[ends[1]];
  const double whole = squared_length(q - p);
  const double share = whole > 0 ? std::clamp(dot(from - p, q - p) / whole, 0.0, 1.0) : 0;
  return PlaceOnLine{edge, share, distance(from, p + share * (q - p))};
}

std::optional<PlaceOnLine> CreaseLines::nearest(const Vec3& from, double within) const {
  return nearest_place<PlaceOnLine>(
      nodes_, order_, std::nextafter(within, HUGE_VAL),
      [&](const BoxNode& node) { return squared_distance(node.box, from); },
      [&](int32_t edge, double) { return place_on(edge, from); });
}

}  // namespace medial
