// SPDX-License-Identifier: GPL-3.0-or-later
// These functions measure how strongly an edge satisfies the two conditions at one of its ends, and
// combine both ends to the significance of the edge.
#pragma once

#include "axis/significance.h"

namespace medial {

// This holds the unit normals of all umbrella triangles, and the largest circumradius in each
// umbrella.
struct UmbrellaShapes {
  Array<Vec3> normal;
  Array<double> radius;  // infinite for an empty umbrella
};

UmbrellaShapes umbrella_shapes(std::span<const Vec3> points, const Umbrellas& umbrellas,
                               const Run& run);

// This describes the end p of an edge pq.
struct EdgeEnd {
  // This is sin(theta_p), the smallest |n_t . direction| over the umbrella of p, or 0 if that is
  // empty.
  double sine = 0;
  double ratio = 0;       // rho_p
  bool umbrella = false;  // pq is in U_p
};

// Measures one end; `direction` is the unit vector along pq, `size` its length.
EdgeEnd edge_end(int32_t p, int32_t q, const Vec3& direction, double size,
                 const Umbrellas& umbrellas, const UmbrellaShapes& shapes);

// Returns the Untried::... bits.
uint8_t untried(const EdgeEnd& p, const EdgeEnd& q);

// Computes a Significance except for the spacing; measure(p, q, direction, size) returns the end p
// of pq.
template <typename Measure>
Significance significance_of_ends(std::span<const Vec3> points, const Edges& edges,
                                  const Measure& measure, const Run& run) {
  const auto count = static_cast<size_t>(edges.count());
  Significance result;
  for (auto* values : {&result.sine, &result.rho, &result.sine_both, &result.rho_both})
    *values = array<double>(count, run);
  result.untried = array<uint8_t>(count, run);
  parallel_for(edges.count(), run, [&](int64_t e) {
    const auto& [p, q] = edges.ends[e];
    const Vec3 pq = points[q] - points[p];
    const double size = length(pq);
    const Vec3 direction = (1 / size) * pq;
    const EdgeEnd at_p = measure(p, q, direction, size), at_q = measure(q, p, direction, size);
    result.sine[e] = std::max(at_p.sine, at_q.sine);
    result.sine_both[e] = std::min(at_p.sine, at_q.sine);
    result.rho[e] = std::max(at_p.ratio, at_q.ratio);
    result.rho_both[e] = std::min(at_p.ratio, at_q.ratio);
    result.untried[e] = untried(at_p, at_q);
  });
  return result;
}

}  // namespace medial
