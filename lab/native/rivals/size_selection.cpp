// SPDX-License-Identifier: GPL-3.0-or-later
#include "rivals/size_selection.h"

#include "base/portable_math.h"
#include "base/rows.h"

namespace medial {
namespace {

double length_of(double share, const Facets& facets) {
  if (!(share >= 0)) {
    throw InvalidInputError("Expected a length of 0 or more, found " + std::to_string(share) +
                            "; 0.05 is a twentieth of the diagonal.");
  }
  const size_t samples = facets.edges.first.size() - 1;  // other points are no samples
  return share * length(box_of(facets.points.first(samples)).extent());
}

}  // namespace

SizeSelection::SizeSelection(const SizeExtraction& wanted, const Facets& facets)
    : Selection({.thresholds = {.theta = wanted.theta}, .side = wanted.side}, facets),
      condition_(wanted.condition),
      least_length_(length_of(wanted.length, facets)) {}

bool SizeSelection::wants(int32_t edge, std::vector<int32_t>& ring) const {
  ring.clear();
  if (size(edge) < least_length_) return false;
  const Side side = wanted().side;
  const bool by_balls = condition_ == SizeCondition::angle_and_length;
  if (side == Side::both && !by_balls) return true;
  const Facets& f = facets();
  const int32_t cell = f.edges.cell[edge];
  if (side != Side::both && !may_be(side, cell, f.sides)) return false;
  ring_of_cells(f.triangulation, f.edges.ends[edge], cell, ring);
  if (side != Side::both && facet_side(ring, f.sides) != side) return false;
  return !by_balls || is_seen_wide(edge, ring);
}

double SizeSelection::size(int32_t edge) const {
  const auto& [p, q] = facets().edges.ends[edge];
  return distance(facets().points[p], facets().points[q]);
}

// A ball of radius R sees pq at the angle 2 asin(|pq| / 2R), which is least for the largest ball.
bool SizeSelection::is_seen_wide(int32_t edge, std::span<const int32_t> ring) const {
  const Facets& f = facets();
  const Vec3& at = f.points[f.edges.ends[edge][0]];
  double largest = 0;
  for (const int32_t cell : ring) {
    const bool infinite = f.triangulation.is_infinite(cell);
    const double radius = infinite ? HUGE_VAL : distance(at, f.voronoi.centre[cell]);
    largest = std::max(largest, radius);
  }
  return size(edge) / (2 * largest) >= portable::sin(wanted().thresholds.theta);
}

}  // namespace medial
