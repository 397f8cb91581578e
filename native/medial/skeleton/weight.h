// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how close a facet is to being selected by MEDIAL: the order of the first two stages.
#pragma once

#include "axis/selection.h"
#include "skeleton/complex.h"

namespace medial {

class FacetWeights {
 public:
  // The arguments must outlive this object.
  FacetWeights(const Facets& facets, const Thresholds& thresholds)
      : facets_(facets), t_(thresholds), selection_({thresholds}, facets) {}

  // Returns whether a Delaunay edge is selected.
  bool selected(int32_t edge) const {
    std::vector<int32_t> none;  // the side `both` needs no ring
    return selection_.wants(edge, none);
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
};

}  // namespace medial
