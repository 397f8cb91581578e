// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how close a facet is to being selected by MEDIAL: the order of the first two stages.
#pragma once

#include "axis/selection.h"
#include "skeleton/complex.h"
#include "skeleton/samples_on_faces.h"

namespace medial {

class FacetWeights {
 public:
  // The arguments must outlive this object. There is a mark per Delaunay edge, or none at all.
  FacetWeights(const Facets& facets, const Thresholds& thresholds,
               std::span<const EdgeMark> marks = {})
      : facets_(facets), t_(thresholds), selection_({thresholds}, facets), marks_(marks) {}

  // Returns whether a Delaunay edge is selected.
  bool selected(int32_t edge) const {
    if (!marks_.empty() && marks_[edge] != EdgeMark::none) return is_certain(edge);
    std::vector<int32_t> none;  // the side `both` needs no ring
    return selection_.wants(edge, none);
  }
  // Returns whether the samples of a Delaunay edge lie on the two sides of a sharp convex edge, or
  // are partners on opposite walls.
  bool is_certain(int32_t edge) const {
    return !marks_.empty() &&
           (marks_[edge] == EdgeMark::into_crease || marks_[edge] == EdgeMark::between_partners);
  }
  // Returns the larger one of theta / theta0 and rho / rho0, or only the one that the criteria use.
  double operator()(int32_t edge) const {
    const double theta =
        part(theta_of(facets_.significance.sines(t_.rule)[edge]), t_.theta, Criteria::ratio);
    return std::max(theta,
                    part(facets_.significance.ratios(t_.rule)[edge], t_.rho, Criteria::angle));
  }

 private:
  double part(double value, double threshold, Criteria without) const {
    if (t_.criteria == without || !(value > 0)) return 0;
    return threshold > 0 ? value / threshold : HUGE_VAL;
  }

  const Facets& facets_;
  Thresholds t_;
  Selection selection_;
  std::span<const EdgeMark> marks_;
};

}  // namespace medial
