// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/convex_creases.h"

namespace medial {
namespace {

constexpr int32_t kLeafOfCreases = 4;
constexpr int kCreaseSteps = 16;
constexpr double kCreasePrecision = 1e-12;  // as a share of the edge

Barycentric along(const Triangle& t, const Edge& ends, double share) {
  std::array<double, 3> at{};
  for (int i = 0; i < 3; ++i) at[i] = t[i] == ends[0] ? 1 - share : t[i] == ends[1] ? share : 0;
  return {at[0], at[1], at[2]};
}

}  // namespace

ConvexCreases::ConvexCreases(const Faces& faces)
    : faces_(faces),
      corner_(faces.mesh().points.size(), 0),
      on_crease_(faces.mesh().points.size(), 0) {
  const auto& edges = faces.creases().edges;
  for (size_t e = 0; e < edges.size(); ++e) {
    if (!faces.is_convex_crease(static_cast<int32_t>(e))) continue;
    segments_.push_back(static_cast<int32_t>(e));
    for (const int32_t end : edges[e].ends) {
      on_crease_[end] = 1;
      corner_[end] = faces.creases().corner[end];
    }
  }
  if (segments_.empty()) return;
  const auto box = [&](int32_t e) {
    Box around = {};
    for (const int32_t t : edges[e].triangles) {
      for (int i = 0; i <= 3; ++i) {
        around.add(faces.point(t, along(faces.mesh().triangles[t], edges[e].ends, i / 3.0)));
      }
    }
    return around;
  };
  const auto describe = [&](Node& node) {
    for (int32_t i = node.begin; i < node.end; ++i) {
      const Box own = box(segments_[i]);
      node.box.add(own.low);
      node.box.add(own.high);
    }
  };
  const auto split = [&](const Node& node) {
    const int axis = longest_axis(node.box.extent());
    return split_in_middle(segments_, node.begin, node.end, [&, axis](int32_t e) {
      const Box own = box(e);
      return std::pair(coordinate(own.low, axis) + coordinate(own.high, axis), e);
    });
  };
  build_tree(nodes_, 0, static_cast<int32_t>(segments_.size()), kLeafOfCreases, describe, split);
}

// Divides the chord and improves the place on the curved edge by secants.
PlaceOnCrease ConvexCreases::place_on(int32_t edge, const Vec3& from) const {
  const MeshEdge& e = faces_.creases().edges[edge];
  const int32_t t = e.triangles[0];
  const Triangle& corners = faces_.mesh().triangles[t];
  const auto point = [&](double share) { return faces_.point(t, along(corners, e.ends, share)); };
  const Vec3 first = faces_.mesh().points[e.ends[0]],
             chord = faces_.mesh().points[e.ends[1]] - first;
  const double squared = squared_length(chord);
  double share = squared > 0 ? std::clamp(dot(from - first, chord) / squared, 0.0, 1.0) : 0;
  Vec3 here = point(share);
  for (int i = 0; i < kCreaseSteps && squared > 0; ++i) {
    const double next = std::clamp(share + dot(from - here, chord) / squared, 0.0, 1.0);
    if (std::abs(next - share) < kCreasePrecision) break;
    share = next;
    here = point(share);
  }
  return {edge, share, here, medial::distance(here, from)};
}

std::optional<PlaceOnCrease> ConvexCreases::nearer(const Vec3& from, double than) const {
  std::optional<PlaceOnCrease> best;
  if (segments_.empty()) return best;
  double within = than;
  visit_nearest(
      nodes_, 0, [&](const Node& node) { return medial::squared_distance(node.box, from); },
      [&] { return within * within; },
      [&](const Node& leaf) {
        for (int32_t i = leaf.begin; i < leaf.end; ++i) {
          const PlaceOnCrease place = place_on(segments_[i], from);
          const bool first = best && place.distance == within && place.edge < best->edge;
          if (place.distance < within || first) {
            best = place;
            within = place.distance;
          }
        }
      });
  return best;
}

}  // namespace medial
