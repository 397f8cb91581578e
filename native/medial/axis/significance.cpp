// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/significance.h"

#include "delaunay/circumcentre.h"

namespace medial {
namespace {

// Unit normals of all umbrella triangles, and the largest circumradius in each umbrella.
struct Shapes {
  Array<Vec3> normal;
  Array<double> radius;  // infinite for an empty umbrella
  // What the Remark puts in their place; empty where it is not asked for.
  Array<Vec3> pole;  // unit vectors
  Array<double> reach;

  const Array<double>& width() const { return reach.empty() ? radius : reach; }
};

Shapes shapes(std::span<const Vec3> points, const Umbrellas& umbrellas, const Run& run) {
  Shapes result{array<Vec3>(umbrellas.items.size(), run),
                array<double>(static_cast<size_t>(umbrellas.size()), HUGE_VAL, run),
                {},
                {}};
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

// Where the Voronoi edge that is dual to the triangle (p, p + a, p + b) crosses the plane through p
// normal to the pole vector, seen from p: a corner of the tangent polygon (Definition 2).
Vec3 polygon_corner(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& pole) {
  const double aa = squared_length(a), bb = squared_length(b);
  const double twice_area = length(cross(a, b));
  const Vec3 centre = (1 / (2 * twice_area)) * (aa * cross(b, normal) + bb * cross(normal, a));
  return centre - (dot(centre, pole) / dot(normal, pole)) * normal;
}

Array<Vec3> unit_vectors(std::span<const Vec3> vectors, const Run& run) {
  auto result = array<Vec3>(vectors.size(), run);
  parallel_for(static_cast<int64_t>(vectors.size()), run,
               [&](int64_t p) { result[p] = normalized(vectors[p]); });
  return result;
}

// Per sample the distance of the farthest corner of its tangent polygon; infinite without corners.
Array<double> polygon_reaches(std::span<const Vec3> points, const Umbrellas& umbrellas,
                              const Array<Vec3>& normals, std::span<const Vec3> poles,
                              const Run& run) {
  auto reach = array<double>(static_cast<size_t>(umbrellas.size()), HUGE_VAL, run);
  parallel_for(umbrellas.size(), run, [&](int64_t p) {
    if (!umbrellas[p].empty()) reach[p] = 0;
    for (int64_t i = umbrellas.offsets[p]; i < umbrellas.offsets[p + 1]; ++i) {
      const auto& [a, b] = umbrellas.items[i];
      const Vec3 corner =
          polygon_corner(normals[i], points[a] - points[p], points[b] - points[p], poles[p]);
      reach[p] = std::max(reach[p], length(corner));
    }
  });
  return reach;
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
  if (!shapes.pole.empty()) {
    end.sine = std::abs(dot(shapes.pole[p], direction));
    end.umbrella = false;  // without umbrellas every edge is tried
  }
  end.ratio = size / shapes.width()[p];
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
                          const Umbrellas& umbrellas, const Run& run, Against against,
                          std::span<const Vec3> pole_vectors) {
  begin_stage(run.progress, "Angles and ratios", 0.8, 0.88);
  const Run quiet{run.threads, nullptr, run.arena};
  Shapes s = shapes(points, umbrellas, quiet);
  if (against == Against::pole || against == Against::pole_and_polygon) {
    s.pole = unit_vectors(pole_vectors, quiet);
  }
  if (against == Against::polygon || against == Against::pole_and_polygon) {
    s.reach = polygon_reaches(points, umbrellas, s.normal, pole_vectors, quiet);
  }
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
