// SPDX-License-Identifier: GPL-3.0-or-later
#include "thickness/tangent_balls.h"

#include <array>

#include "base/vec3.h"

namespace medial {
namespace {

constexpr double kFacing = 2;  // distances of samples on the facing wall; chosen: thickness

// This is the width of the ball that is tangent at one sample and touches the other one.
struct Width {
  double diameter = HUGE_VAL;
  double between = HUGE_VAL;  // between walls only, and with the other one's plane
};

// Returns the width; `inward` is 1 if the balls are against the normals, -1 if along them. The
// plane at q stands for the surface as far as the samples round it. Where these end, as at parts
// that cross, they seem far apart, and samples on the other wall say how far apart they are.
Width width(const Vec3& p, const Vec3& q, const Vec3& normal_p, const Vec3& normal_q,
            bool q_at_edge, bool q_reflex, double spacing, double inward) {
  const Vec3 apart = p - q;
  const double height = inward * dot(normal_p, apart);
  if (!(height > 0)) return {};
  Width found{squared_length(apart) / height};
  const double cosine = dot(normal_p, normal_q);
  if (cosine > kOpposite || (q_at_edge && !q_reflex)) return found;
  // The ball touches the other wall next to q. A ball tangent to the plane at q, too, has an error
  // smaller by the ratio of the wall's curvature to the ball's, and none between planes.
  found.between = found.diameter;
  const double planes = -2 * inward * dot(normal_q, apart) / (1 - cosine);
  const Vec3 foot = p - 0.5 * planes * inward * (normal_p - normal_q);
  if (!q_at_edge && planes > 0 && distance(foot, q) <= spacing) {
    found.between = std::min(found.between, planes);
  }
  return found;
}

// Returns the widths at both ends of each facet.
std::vector<std::array<Width, 2>> widths(std::span<const Vec3> points, const Tangents& tangents,
                                         const Edges& edges, std::span<const double> spacing,
                                         std::span<const int32_t> edge_ids, double inward,
                                         const Run& run) {
  std::vector<std::array<Width, 2>> result(edge_ids.size());
  const auto at = [&](int32_t p, int32_t q) {
    if (tangents.edge[p]) return Width{};
    return width(points[p], points[q], tangents.normals[p], tangents.normals[q], tangents.edge[q],
                 tangents.reflex[q], std::min(spacing[q], kFacing * spacing[p]), inward);
  };
  parallel_for(static_cast<int64_t>(edge_ids.size()), run, [&](int64_t i) {
    const auto& [p, q] = edges.ends[edge_ids[i]];
    result[i] = {at(p, q), at(q, p)};
  });
  return result;
}

}  // namespace

TangentBalls tangent_balls(std::span<const Vec3> points, const Tangents& tangents,
                           const Edges& edges, std::span<const double> spacing,
                           std::span<const int32_t> edge_ids, Side side, const Run& run) {
  const size_t count = tangents.normals.size();
  TangentBalls balls{std::vector<double>(count, HUGE_VAL), std::vector<double>(count, HUGE_VAL),
                     std::vector<uint8_t>(count, 0)};
  std::vector<double> nearest(count, HUGE_VAL);  // the smallest ball between walls, without planes
  const double inward = side == Side::inner ? 1 : -1;
  const auto found = widths(points, tangents, edges, spacing, edge_ids, inward, run);
  for (size_t i = 0; i < edge_ids.size(); ++i) {
    for (int end = 0; end < 2; ++end) {
      const int32_t p = edges.ends[edge_ids[i]][end];
      const Width& w = found[i][end];
      balls.touched[p] = 1;
      balls.any[p] = std::min({balls.any[p], w.diameter, w.between});
      // This uses the plane of the sample next to the contact, not the plane with the smallest
      // result.
      if (w.between < HUGE_VAL && w.diameter < nearest[p]) {
        nearest[p] = w.diameter;
        balls.wall[p] = w.between;
      }
    }
  }
  return balls;
}

}  // namespace medial
