// Which Delaunay edges MEDIAL selects (Dey & Zhao, sect. 3): a mask over the significance arrays.
#pragma once

#include <numbers>

#include "axis/significance.h"

namespace medial {

enum class Criteria : int32_t { angle_or_ratio = 0, angle = 1, ratio = 2 };

struct Thresholds {
  double theta = std::numbers::pi / 8;
  double rho = 8;
  Rule rule = Rule::either;
  Criteria criteria = Criteria::angle_or_ratio;
};

// A value over the ends that are tried, given that over both; nothing is above 0 where none is.
double tried_sine(const Significance& significance, int64_t edge, Rule rule);
double tried_rho(const Significance& significance, int64_t edge, Rule rule);

// Angle[theta] and Ratio[rho] of an edge.
class Conditions {
 public:
  Conditions(const Significance& significance, const Thresholds& thresholds);

  bool angle(int64_t edge) const;
  bool ratio(int64_t edge) const;
  bool either(int64_t edge) const { return angle(edge) || ratio(edge); }

 private:
  const Significance& s_;
  Thresholds t_;
  double sine_;  // the largest that does not satisfy
};

}  // namespace medial
