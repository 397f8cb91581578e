// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how close a facet is to being selected by MEDIAL: the order of the first two stages.
#pragma once

#include "axis/selection.h"
#include "collapse/complex.h"
#include "walls/samples_on_faces.h"

namespace medial {

// Returns the larger one of theta / theta0 and rho / rho0, or only the one that the criteria use.
inline double share_of_thresholds(double sine, double rho, const Thresholds& t) {
  const auto part = [&](double value, double threshold, Criteria without) {
    if (t.criteria == without || !(value > 0)) return 0.0;
    return threshold > 0 ? value / threshold : HUGE_VAL;
  };
  return std::max(part(theta_of(sine), t.theta, Criteria::ratio),
                  part(rho, t.rho, Criteria::angle));
}

// How a facet was chosen: not at all, by the thresholds, or by the faces, which are certain.
enum class Chosen : uint8_t { no, by_thresholds, by_faces };

// The facets are those of a complex, by InnerComplex::dual.
class FacetWeights {
 public:
  virtual ~FacetWeights() = default;
  virtual bool selected(int32_t dual) const = 0;
  // Returns whether the faces say that the facet is there: its samples lie on the two sides of a
  // sharp convex edge, or are partners on opposite walls.
  virtual bool is_certain(int32_t dual) const = 0;
  virtual double operator()(int32_t dual) const = 0;
};

// The weights of Delaunay edges.
class EdgeWeights : public FacetWeights {
 public:
  // The arguments must outlive this object. There is a mark per Delaunay edge, or none at all.
  EdgeWeights(const Facets& facets, const Thresholds& thresholds,
              std::span<const EdgeMark> marks = {})
      : facets_(facets), t_(thresholds), selection_({thresholds}, facets), marks_(marks) {}

  bool selected(int32_t edge) const override {
    if (!marks_.empty() && marks_[edge] != EdgeMark::none) return is_certain(edge);
    std::vector<int32_t> none;  // the side `both` needs no ring
    return selection_.wants(edge, none);
  }
  bool is_certain(int32_t edge) const override {
    return !marks_.empty() &&
           (marks_[edge] == EdgeMark::into_crease || marks_[edge] == EdgeMark::between_partners);
  }
  double operator()(int32_t edge) const override {
    return share_of_thresholds(facets_.significance.sines(t_.rule)[edge],
                               facets_.significance.ratios(t_.rule)[edge], t_);
  }

 private:
  const Facets& facets_;
  Thresholds t_;
  Selection selection_;
  std::span<const EdgeMark> marks_;
};

}  // namespace medial
