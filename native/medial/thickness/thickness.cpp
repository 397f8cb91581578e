// SPDX-License-Identifier: GPL-3.0-or-later
#include "thickness/thickness.h"

#include "base/nearest_ball.h"
#include "base/rows.h"
#include "thickness/extrapolation.h"

namespace medial {
namespace {

// The values are in the order of the samples.
struct Values {
  std::vector<double> lengths;
  std::vector<uint8_t> measured;
};

std::vector<int32_t> selected_edges(const Thresholds& thresholds, Side side, const Facets& facets,
                                    const Run& run) {
  std::vector<int32_t> all = all_rows(facets.edges.count());
  return selected(Selection({.thresholds = thresholds, .side = side}, facets), all, run);
}

Tangents tangents_of(const ThicknessInput& input, const Samples& samples) {
  Tangents tangents;
  tangents.normals.reserve(samples.row.size());
  tangents.edge.reserve(samples.row.size());
  for (const int32_t row : samples.row) {
    tangents.normals.push_back(normalized(input.normals[row]));
    tangents.edge.push_back(input.at_edge && (*input.at_edge)[row]);
  }
  return tangents;
}

// Marks the samples on sharp edges that jut into the side of the balls: their neighbours on the
// surface are, on balance, away from that side.
std::vector<uint8_t> reflex_edges(const Tangents& tangents, const Facets& facets, Side side) {
  std::vector<double> height(tangents.edge.size(), 0);
  const auto add = [&](int32_t at, int32_t neighbour, double reach) {
    const Vec3 away = facets.points[neighbour] - facets.points[at];
    if (tangents.edge[at] && squared_length(away) <= reach * reach)
      height[at] += dot(tangents.normals[at], away);
  };
  const auto& spacing = facets.significance.spacing;
  for (const auto& [p, q] : facets.edges.ends) {
    if (!tangents.edge[p] && !tangents.edge[q]) continue;
    const double reach = 2 * std::min(spacing[p], spacing[q]);
    add(p, q, reach);
    add(q, p, reach);
  }
  std::vector<uint8_t> reflex;
  reflex.reserve(height.size());
  for (size_t p = 0; p < height.size(); ++p) {
    reflex.push_back(tangents.edge[p] && (side == Side::inner ? height[p] > 0 : height[p] < 0));
  }
  return reflex;
}

std::vector<uint8_t> finite(const std::vector<double>& values) {
  std::vector<uint8_t> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(value < HUGE_VAL);
  return result;
}

// Returns the ball at a sample, the least value that may be filled in. It is unknown (0) for a
// sample without a facet; but outside, such a sample has nothing in front of it (infinity), unless
// it is on an edge.
double own_ball(const TangentBalls& balls, const Tangents& tangents, int32_t p, Side side) {
  if (balls.any[p] < HUGE_VAL) return balls.any[p];
  const bool open = side == Side::outer && !balls.touched[p] && !tangents.edge[p];
  return open ? HUGE_VAL : 0;
}

Values by_tangent_balls(const ThicknessInput& input, const ThicknessOptions& options,
                        const Samples& samples, const Facets& facets, const Run& run) {
  Tangents tangents = tangents_of(input, samples);
  tangents.reflex = reflex_edges(tangents, facets, options.side);
  const auto ids = selected_edges(options.thresholds, options.side, facets, run);
  TangentBalls balls = tangent_balls(facets.points, tangents, facets.edges,
                                     facets.significance.spacing, ids, options.side, run);
  const bool walls = options.mode == ThicknessMode::wall;
  Values found{walls ? balls.wall : balls.any, {}};
  found.measured = finite(found.lengths);
  extrapolate(found.lengths, balls.any, facets.points, tangents, facets.edges, facets.significance,
              run);
  for (int32_t p = 0; p < samples.count(); ++p) {
    if (found.measured[p]) continue;
    found.lengths[p] = std::max(found.lengths[p], own_ball(balls, tangents, p, options.side));
  }
  return found;
}

// Collects the balls at the finite vertices of some facets.
std::vector<Ball> balls_of(std::span<const int32_t> edge_ids, const Facets& facets,
                           const Run& run) {
  const auto marked = cells_round(edge_ids, facets.triangulation, facets.edges, run);
  std::vector<Ball> balls;
  for (int32_t c = 0; c < facets.triangulation.finite_cells; ++c) {
    if (!marked[c]) continue;
    const Vec3& centre = facets.voronoi.centre[c];
    const double radius = distance(centre, facets.points[facets.triangulation.cells[c][0]]);
    if (radius < HUGE_VAL) balls.push_back({centre, radius});
  }
  return balls;
}

Values by_nearest_balls(const ThicknessOptions& options, const Samples& samples,
                        const Facets& facets, const Run& run) {
  const Thresholds clear{.theta = kScanTheta, .rule = Rule::both, .criteria = Criteria::angle};
  const auto balls = balls_of(selected_edges(clear, options.side, facets, run), facets, run);
  const NearestBall nearest(balls);
  Values found{std::vector<double>(static_cast<size_t>(samples.count()), HUGE_VAL), {}};
  parallel_for(samples.count(), run, [&](int64_t p) {
    const Vec3& at = facets.points[p];
    const int32_t id = nearest.find(at);
    if (id < 0) return;
    const auto& [centre, radius] = balls[id];
    // Outside, a sample with nothing in front of it is not in a gap just because there is one far
    // away.
    if (options.side == Side::outer && distance(at, centre) > 2 * radius) return;
    found.lengths[p] = 2 * radius;
  });
  found.measured = finite(found.lengths);
  return found;
}

}  // namespace

WallThickness thickness(const ThicknessInput& input, const ThicknessOptions& options,
                        const Samples& samples, const Facets& facets, const Run& run) {
  const Values found = options.mode == ThicknessMode::scan
                           ? by_nearest_balls(options, samples, facets, run)
                           : by_tangent_balls(input, options, samples, facets, run);
  const std::vector<int32_t> order = samples_by_row(samples);
  return {rows_of(found.lengths, order), rows_of(found.measured, order)};
}

}  // namespace medial
