// Which Delaunay edges MEDIAL selects (Dey & Zhao, sect. 3): a mask over the significance arrays.
#pragma once

#include <numbers>

#include "significance.h"

namespace medial {

enum class Criteria : int32_t { angle_or_ratio = 0, angle = 1, ratio = 2 };

struct Thresholds {
  double theta = std::numbers::pi / 8;
  double rho = 8;
  Rule rule = Rule::either;
  Criteria criteria = Criteria::angle_or_ratio;
};

// A value over the ends that are tried, given that over both; nothing is above 0 where none is.
inline double tried(double larger, double smaller, bool try_larger, bool try_smaller, Rule rule) {
  if (rule == Rule::both) return try_larger && try_smaller ? smaller : 0;
  return try_larger ? larger : try_smaller ? smaller : 0;
}

inline double tried_sine(const Significance& s, int64_t edge, Rule rule) {
  const uint8_t untried = s.untried[edge];
  return tried(s.sine[edge], s.sine_both[edge], !(untried & larger_theta),
               !(untried & smaller_theta), rule);
}

inline double tried_rho(const Significance& s, int64_t edge, Rule rule) {
  const uint8_t untried = s.untried[edge];
  return tried(s.rho[edge], s.rho_both[edge], !(untried & larger_rho), !(untried & smaller_rho),
               rule);
}

// Angle[theta] and Ratio[rho].
class Conditions {
 public:
  Conditions(const Significance& significance, const Thresholds& thresholds)
      : s_(significance), t_(thresholds), sine_(largest_sine(thresholds.theta)) {}

  bool angle(int64_t edge) const {
    return t_.criteria != Criteria::ratio && tried_sine(s_, edge, t_.rule) > sine_;
  }
  bool ratio(int64_t edge) const {
    return t_.criteria != Criteria::angle && tried_rho(s_, edge, t_.rule) > t_.rho;
  }
  bool either(int64_t edge) const { return angle(edge) || ratio(edge); }

 private:
  const Significance& s_;
  Thresholds t_;
  double sine_;
};

}  // namespace medial
