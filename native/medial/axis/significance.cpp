// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/significance.h"

#include "axis/edge_ends.h"
#include "delaunay/circumcentre.h"

namespace medial {
namespace {

// Returns the bits of an end from which the edge is not tried.
int untried_bits(bool has_larger_theta, bool has_larger_rho) {
  return (has_larger_theta ? Untried::larger_theta : Untried::smaller_theta) |
         (has_larger_rho ? Untried::larger_rho : Untried::smaller_rho);
}

}  // namespace

UmbrellaShapes umbrella_shapes(std::span<const Vec3> points, const Umbrellas& umbrellas,
                               const Run& run) {
  UmbrellaShapes result{array<Vec3>(umbrellas.items.size(), run),
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

EdgeEnd edge_end(int32_t p, int32_t q, const Vec3& direction, double size,
                 const Umbrellas& umbrellas, const UmbrellaShapes& shapes) {
  EdgeEnd end;
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

uint8_t untried(const EdgeEnd& p, const EdgeEnd& q) {
  const bool p_theta = p.sine >= q.sine, p_rho = p.ratio >= q.ratio;
  int bits = 0;
  if (p.umbrella) bits |= untried_bits(p_theta, p_rho);
  if (q.umbrella) bits |= untried_bits(!p_theta, !p_rho);
  return static_cast<uint8_t>(bits);
}

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
  const Run quiet{run.threads, nullptr, run.arena};
  UmbrellaShapes shapes = umbrella_shapes(points, umbrellas, quiet);
  const auto measure = [&](int32_t p, int32_t q, const Vec3& direction, double size) {
    return edge_end(p, q, direction, size, umbrellas, shapes);
  };
  Significance result = significance_of_ends(points, edges, measure, run);
  result.spacing = std::move(shapes.radius);
  return result;
}

}  // namespace medial
