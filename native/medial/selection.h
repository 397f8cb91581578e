// Which Delaunay edges MEDIAL selects (Dey & Zhao, sect. 3): a mask over the significance arrays.
#pragma once

#include <numbers>

#include "significance.h"

namespace medial {

enum class Rule : int32_t { either = 0, both = 1 };
enum class Criteria : int32_t { angle_or_ratio = 0, angle = 1, ratio = 2 };

struct Thresholds {
  double theta = std::numbers::pi / 8;
  double rho = 8;
  Rule rule = Rule::either;
  Criteria criteria = Criteria::angle_or_ratio;
};

inline bool satisfies_angle(const Significance& s, int64_t edge, const Thresholds& t) {
  if (t.criteria == Criteria::ratio) return false;
  return (t.rule == Rule::either ? s.theta : s.theta_both)[edge] > t.theta;
}

inline bool satisfies_ratio(const Significance& s, int64_t edge, const Thresholds& t) {
  if (t.criteria == Criteria::angle) return false;
  return (t.rule == Rule::either ? s.rho : s.rho_both)[edge] > t.rho;
}

// Ascending ids of the edges that satisfy Angle[theta] or Ratio[rho].
std::vector<int32_t> select(const Significance& significance, const Thresholds& thresholds, const Run& run);

}  // namespace medial
