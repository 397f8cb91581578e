// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/selection.h"

namespace medial {
namespace {

// Combines the values at the two ends of an edge by a rule; only ends that are tried count. Returns
// 0, which passes no condition, if the rule lacks an end.
double tried(double larger, double smaller, bool try_larger, bool try_smaller, Rule rule) {
  if (rule == Rule::both) return try_larger && try_smaller ? smaller : 0;
  return try_larger ? larger : try_smaller ? smaller : 0;
}

double tried_sine(const Significance& s, int64_t edge, Rule rule) {
  const uint8_t untried = s.untried[edge];
  return tried(s.sine[edge], s.sine_both[edge], !(untried & Untried::larger_theta),
               !(untried & Untried::smaller_theta), rule);
}

double tried_rho(const Significance& s, int64_t edge, Rule rule) {
  const uint8_t untried = s.untried[edge];
  return tried(s.rho[edge], s.rho_both[edge], !(untried & Untried::larger_rho),
               !(untried & Untried::smaller_rho), rule);
}

}  // namespace

void require_in_range(const Thresholds& thresholds) {
  if (!(thresholds.theta >= 0 && thresholds.theta <= std::numbers::pi / 2)) {
    throw InvalidInputError("Expected theta from 0 to pi/2 radians, found " +
                            std::to_string(thresholds.theta) + "; the paper uses pi/8.");
  }
  if (!(thresholds.rho >= 0)) {
    throw InvalidInputError("Expected rho of 0 or more, found " + std::to_string(thresholds.rho) +
                            "; the paper uses 8.");
  }
}

Selection::Selection(const Extraction& wanted, const Facets& facets)
    : wanted_(wanted), facets_(facets) {
  require_in_range(wanted.thresholds);
  if (wanted.side == Side::crossing) {
    throw InvalidInputError(
        "Expected side INNER, OUTER or BOTH, found CROSSING; choose one of them.");
  }
  sine_ = largest_sine(wanted.thresholds.theta);
}

bool Selection::wants(int32_t edge, std::vector<int32_t>& ring) const {
  ring.clear();
  if (!satisfies_angle(edge) && !satisfies_ratio(edge)) return false;
  const Side side = wanted_.side;
  const bool limited = wanted_.limit_set && !satisfies_angle(edge);
  if (side == Side::both && !limited) return true;
  const int32_t cell = facets_.edges.cell[edge];
  if (side != Side::both && !may_be(side, cell, facets_.sides)) return false;
  ring_of_cells(facets_.triangulation, facets_.edges.ends[edge], cell, ring);
  if (side != Side::both && facet_side(ring, facets_.sides) != side) return false;
  return !limited || in_limit_set(edge, ring);
}

FacetAttributes Selection::attributes(int32_t edge, std::span<const int32_t> ring) const {
  const Rule rule = wanted_.thresholds.rule;
  const bool known = wanted_.side != Side::both;
  return {theta_of(facets_.significance.sines(rule)[edge]), facets_.significance.ratios(rule)[edge],
          known ? wanted_.side : facet_side(ring, facets_.sides)};
}

bool Selection::satisfies_angle(int32_t edge) const {
  const Thresholds& t = wanted_.thresholds;
  return t.criteria != Criteria::ratio && tried_sine(facets_.significance, edge, t.rule) > sine_;
}

bool Selection::satisfies_ratio(int32_t edge) const {
  const Thresholds& t = wanted_.thresholds;
  return t.criteria != Criteria::angle && tried_rho(facets_.significance, edge, t.rule) > t.rho;
}

// Definition 4 requires |pq| >= eps^(1/4) mu, with mu the smallest ball radius at the facet's
// vertices and eps = R / mu, where R = |pq| / rho is the umbrella radius of the Ratio condition.
bool Selection::in_limit_set(int32_t edge, std::span<const int32_t> ring) const {
  const auto& [p, q] = facets_.edges.ends[edge];
  const Vec3& at = facets_.points[p];
  double mu = HUGE_VAL;
  for (const int32_t cell : ring) {
    if (facets_.triangulation.is_infinite(cell)) continue;
    mu = std::min(mu, distance(at, facets_.voronoi.centre[cell]));
  }
  const double size = distance(at, facets_.points[q]);
  const double rho = tried_rho(facets_.significance, edge, wanted_.thresholds.rule);
  const double epsilon = size / (rho * mu);
  return size >= std::sqrt(std::sqrt(epsilon)) * mu;
}

std::vector<int32_t> selected(const Selection& selection, std::span<const int32_t> edges,
                              const Run& run) {
  std::vector<std::vector<int32_t>> rings(run.threads);
  return parallel_append<int32_t>(static_cast<int64_t>(edges.size()), run,
                                  [&](int64_t i, std::vector<int32_t>& kept, int worker) {
                                    if (selection.wants(edges[i], rings[worker]))
                                      kept.push_back(static_cast<int32_t>(i));
                                  });
}

}  // namespace medial
