#include "significance.h"

#include "circumcentre.h"

namespace medial {
namespace {

// Unit normals of all umbrella triangles, and the largest circumradius in each umbrella.
struct Shapes {
  std::vector<Vec3> normal;
  std::vector<double> radius;
};

double circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double twice_area = length(cross(u, v));
  return length(u) * length(v) * distance(b, c) / (2 * twice_area);
}

Shapes shapes(std::span<const Vec3> points, const Umbrellas& umbrellas, const Run& run) {
  Shapes result;
  result.normal.resize(umbrellas.items.size());
  result.radius.assign(static_cast<size_t>(umbrellas.size()), 0);
  parallel_for(umbrellas.size(), run, [&](int64_t p) {
    for (int64_t i = umbrellas.offsets[p]; i < umbrellas.offsets[p + 1]; ++i) {
      const auto& [a, b] = umbrellas.items[i];
      result.normal[i] = unit_normal(points[p], points[a], points[b]).direction;
      result.radius[p] = std::max(result.radius[p], circumradius(points[p], points[a], points[b]));
    }
  });
  return result;
}

// sin(theta_p): the smallest |n_t . direction| over the umbrella of p; 0 for an empty umbrella.
double sine(int32_t p, const Vec3& direction, const Umbrellas& umbrellas, const Shapes& shapes) {
  double least = 1;
  for (int64_t i = umbrellas.offsets[p]; i < umbrellas.offsets[p + 1]; ++i) {
    least = std::min(least, std::abs(dot(shapes.normal[i], direction)));
  }
  return umbrellas.offsets[p] == umbrellas.offsets[p + 1] ? 0 : least;
}

double ratio(double edge_length, double radius) { return radius > 0 ? edge_length / radius : 0; }

}  // namespace

Significance significance(std::span<const Vec3> points, const Edges& edges, const Umbrellas& umbrellas,
                          const Run& run) {
  begin_stage(run.progress, "Angles and ratios", 0.8, 0.88);
  const Shapes s = shapes(points, umbrellas, {run.threads, nullptr});
  const auto count = static_cast<size_t>(edges.count());
  Significance result{std::vector<double>(count), std::vector<double>(count),
                      std::vector<double>(count), std::vector<double>(count)};
  parallel_for(edges.count(), run, [&](int64_t e) {
    const auto& [p, q] = edges.ends[e];
    const Vec3 pq = points[q] - points[p];
    const double size = length(pq);
    const Vec3 direction = (1 / size) * pq;
    const double sine_p = sine(p, direction, umbrellas, s), sine_q = sine(q, direction, umbrellas, s);
    result.theta[e] = std::asin(std::max(sine_p, sine_q));
    result.theta_both[e] = std::asin(std::min(sine_p, sine_q));
    const double ratio_p = ratio(size, s.radius[p]), ratio_q = ratio(size, s.radius[q]);
    result.rho[e] = std::max(ratio_p, ratio_q);
    result.rho_both[e] = std::min(ratio_p, ratio_q);
  });
  return result;
}

}  // namespace medial
