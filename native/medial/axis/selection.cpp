#include "axis/selection.h"

namespace medial {
namespace {

double tried(double larger, double smaller, bool try_larger, bool try_smaller, Rule rule) {
  if (rule == Rule::both) return try_larger && try_smaller ? smaller : 0;
  return try_larger ? larger : try_smaller ? smaller : 0;
}

}  // namespace

double tried_sine(const Significance& s, int64_t edge, Rule rule) {
  const uint8_t untried = s.untried[edge];
  return tried(s.sine[edge], s.sine_both[edge], !(untried & larger_theta),
               !(untried & smaller_theta), rule);
}

double tried_rho(const Significance& s, int64_t edge, Rule rule) {
  const uint8_t untried = s.untried[edge];
  return tried(s.rho[edge], s.rho_both[edge], !(untried & larger_rho), !(untried & smaller_rho),
               rule);
}

Conditions::Conditions(const Significance& significance, const Thresholds& thresholds)
    : s_(significance), t_(thresholds), sine_(largest_sine(thresholds.theta)) {}

bool Conditions::angle(int64_t edge) const {
  return t_.criteria != Criteria::ratio && tried_sine(s_, edge, t_.rule) > sine_;
}

bool Conditions::ratio(int64_t edge) const {
  return t_.criteria != Criteria::angle && tried_rho(s_, edge, t_.rule) > t_.rho;
}

}  // namespace medial
