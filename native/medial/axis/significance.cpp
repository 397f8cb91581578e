// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/significance.h"

#include "delaunay/circumcentre.h"

namespace medial {
namespace {

// Unit normals of all umbrella triangles, and the largest circumradius in each umbrella.
struct Shapes {
  Array<Vec3> normal;
  Array<double> radius;  // infinite for an empty umbrella
};

Shapes shapes(std::span<const Vec3> points, const Umbrellas& umbrellas, const Run& run) {
  Shapes result{array<Vec3>(umbrellas.items.size(), run),
                array<double>(static_cast<size_t>(umbrellas.size()), HUGE_VAL, run)};
  parallel_for(umbrellas.size(), run, [&](int64_t p) {
    if (!umbrellas[p].empty()) result.radius[p] = 0;
    for (int64_t i = umbrellas.offsets[p]; i < umbrellas.offsets[p + 1]; ++i) {
      const auto& [a, b] = umbrellas.items[i];
      result.normal[i] = unit_normal(points[p], points[a], points[b]).direction;
      result.radius[p] = std::max(result.radius[p], circumradius(points[p], points[a], points[b]));
    }
  });
  return result;
}

// One end of an edge.
struct End {
  // sin(theta_p): the smallest |n_t . direction| over the umbrella of p; 0 for an empty one.
  double sine = 0;
  double ratio = 0;       // rho_p
  bool umbrella = false;  // pq is in U_p
};

End end_at(int32_t p, int32_t q, const Vec3& direction, double size, const Umbrellas& umbrellas,
           const Shapes& shapes) {
  End end;
  const int64_t begin = umbrellas.offsets[p], stop = umbrellas.offsets[p + 1];
  if (begin == stop) return end;
  end.sine = 1;
  for (int64_t i = begin; i < stop; ++i) {
    end.sine = std::min(end.sine, std::abs(dot(shapes.normal[i], direction)));
    const auto& [a, b] = umbrellas.items[i];
    end.umbrella |= a == q || b == q;
  }
  end.ratio = size / shapes.radius[p];
  return end;
}

// Of an end from which the edge is not tried.
int untried_bits(bool has_larger_theta, bool has_larger_rho) {
  return (has_larger_theta ? Untried::larger_theta : Untried::smaller_theta) |
         (has_larger_rho ? Untried::larger_rho : Untried::smaller_rho);
}

uint8_t untried(const End& p, const End& q) {
  const bool p_theta = p.sine >= q.sine, p_rho = p.ratio >= q.ratio;
  int bits = 0;
  if (p.umbrella) bits |= untried_bits(p_theta, p_rho);
  if (q.umbrella) bits |= untried_bits(!p_theta, !p_rho);
  return static_cast<uint8_t>(bits);
}

}  // namespace

double largest_sine(double theta) {
  double low = 0, high = 1;
  if (theta_of(high) <= theta) return high;
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return low;
    (theta_of(middle) <= theta ? low : high) = middle;
  }
}

Significance significance(std::span<const Vec3> points, const Edges& edges,
                          const Umbrellas& umbrellas, const Run& run) {
  begin_stage(run.progress, "Angles and ratios", 0.8, 0.88);
  Shapes s = shapes(points, umbrellas, {run.threads, nullptr, run.arena});
  const auto count = static_cast<size_t>(edges.count());
  Significance result;
  for (auto* values : {&result.sine, &result.rho, &result.sine_both, &result.rho_both})
    *values = array<double>(count, run);
  result.untried = array<uint8_t>(count, run);
  const auto judge = [&](int64_t e) {
    const auto& [p, q] = edges.ends[e];
    const Vec3 pq = points[q] - points[p];
    const double size = length(pq);
    const Vec3 direction = (1 / size) * pq;
    const End at_p = end_at(p, q, direction, size, umbrellas, s),
              at_q = end_at(q, p, direction, size, umbrellas, s);
    result.sine[e] = std::max(at_p.sine, at_q.sine);
    result.sine_both[e] = std::min(at_p.sine, at_q.sine);
    result.rho[e] = std::max(at_p.ratio, at_q.ratio);
    result.rho_both[e] = std::min(at_p.ratio, at_q.ratio);
    result.untried[e] = untried(at_p, at_q);
  };
  parallel_for(edges.count(), run, judge);
  result.spacing = std::move(s.radius);
  return result;
}

}  // namespace medial
