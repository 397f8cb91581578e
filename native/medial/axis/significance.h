// SPDX-License-Identifier: GPL-3.0-or-later
// How strongly each Delaunay edge pq satisfies the two conditions (Dey & Zhao, sect. 3.1 and 3.2),
// for all thresholds at once: the Angle condition [theta0] holds at p exactly when theta_p >
// theta0, the Ratio condition [rho0] exactly when rho_p > rho0, where
//   theta_p = pi/2 - max over t in U_p of angle(n_t, pq) = asin(min |n_t . pq| / |pq|)
//   rho_p   = |pq| / max over t in U_p of R_t
#pragma once

#include <medial/options.h>

#include "axis/umbrellas.h"
#include "base/portable_math.h"

namespace medial {

// This holds for each edge the larger value of the two ends (rule EITHER) and the smaller one (rule
// BOTH).
struct Significance {
  Array<double> sine, rho;  // sine of theta: an arcsine is dearer than all else about an edge
  Array<double> sine_both, rho_both;
  Array<uint8_t> untried;  // Untried::... bits
  // The spacing of each sample is the largest circumradius in its umbrella, infinite if that is
  // empty.
  Array<double> spacing;

  const Array<double>& sines(Rule rule) const { return rule == Rule::either ? sine : sine_both; }
  const Array<double>& ratios(Rule rule) const { return rule == Rule::either ? rho : rho_both; }
};

// Step 5 of MEDIAL tries pq from p only if pq is not in U_p. These bits mark the values from an end
// that is not tried for this reason. They matter below rho0 = 2 and, by rounding, at theta0 = 0;
// otherwise such an end fails anyway.
struct Untried {
  static constexpr uint8_t larger_theta = 1, smaller_theta = 2, larger_rho = 4, smaller_rho = 8;
};

inline double theta_of(double sine) { return portable::asin(sine); }

// Returns the largest sine whose theta is not above a threshold.
double largest_sine(double theta);

Significance significance(std::span<const Vec3> points, const Edges& edges,
                          const Umbrellas& umbrellas, const Run& run);

}  // namespace medial
