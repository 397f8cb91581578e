// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/wall_partners.h"

#include "base/sort_unique.h"

namespace medial {
namespace {

// How far one sample is below the wall of the other one, in thicknesses.
constexpr double kLeastDepth = 0.25, kMostDepth = 2;  // chosen: unseen

}  // namespace

WallPartners::WallPartners(std::span<const int32_t> partner, const Samples& samples, const Run& run)
    : samples_(samples) {
  std::vector<Edge> pairs;
  for (size_t row = 0; row < partner.size(); ++row) {
    if (partner[row] < 0) continue;
    const int32_t p = samples.point_of_row[row], q = samples.point_of_row[partner[row]];
    if (p == q) continue;
    pairs.push_back({p, q});
    pairs.push_back({q, p});
  }
  sort_unique(pairs);
  partners_ = csr_of_pairs(pairs, samples.row.size(), run);
}

bool WallPartners::are_across(const Edge& samples) const {
  const auto& [p, q] = samples;
  if (std::max(p, q) >= samples_.count()) return false;  // auxiliary points follow the samples
  for (const int32_t across_p : partners_[p]) {
    if (across_p == q) return true;
    for (const int32_t across_q : partners_[q]) {
      if (are_across(p, across_p, q, across_q)) return true;
    }
  }
  return false;
}

bool WallPartners::are_across(int32_t p, int32_t across_p, int32_t q, int32_t across_q) const {
  const auto& at = samples_.points;
  const Vec3 up = at[p] - at[across_p], down = at[q] - at[across_q];
  const double thick_p = length(up), thick_q = length(down);
  if (!(dot(up, down) < kOpposite * thick_p * thick_q)) return false;
  const double depth = dot(at[p] - at[q], up) / thick_p;
  return depth > kLeastDepth * std::min(thick_p, thick_q) &&
         depth < kMostDepth * std::max(thick_p, thick_q);
}

void mark_partners(const WallPartners& partners, const Edges& edges, std::vector<EdgeMark>& marks,
                   const Run& run) {
  if (marks.empty()) marks.assign(edges.ends.size(), EdgeMark::none);
  parallel_for(edges.count(), run, [&](int64_t e) {
    if (partners.are_across(edges.ends[e])) marks[e] = EdgeMark::between_partners;
  });
}

}  // namespace medial
