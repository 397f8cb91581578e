// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/local_quadric.h"

#include "base/normal_equations.h"

namespace medial {
namespace {

constexpr int kTerms = 6;
constexpr double kSmallestPivot = 1e-9;  // of a diagonal element: columns depend; derived: rounding
using Equations = NormalEquations<kTerms>;
using Terms = Equations::Terms;

// The exponents of u and v in each term.
constexpr std::array<std::array<size_t, 2>, kTerms> kPowers{
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};

Terms monomials(double u, double v) { return {1, u, v, u * u, u * v, v * v}; }

// The weighted sums of a fit. Each has a lane for every fourth point, so that compilers use vectors
// without changing the order in which a lane adds.
class Sums {
 public:
  static constexpr size_t kLanes = 4;
  using Lanes = std::array<double, kLanes>;

  // Adds four points: their weights, coordinates in the plane, and heights.
  void add(const Lanes& weight, const Lanes& u, const Lanes& v, const Lanes& height) {
    for (size_t k = 0; k < kLanes; ++k) {
      const double w = weight[k], x = u[k], y = v[k], wx = w * x, wy = w * y, wxx = wx * x,
                   wxy = wx * y, wyy = wy * y, wxxx = wxx * x, wxxy = wxx * y, wxyy = wxy * y,
                   wyyy = wyy * y;
      const std::array<double, kMoments> all{w,        wx,       wy,       wxx,      wxy,
                                             wyy,      wxxx,     wxxy,     wxyy,     wyyy,
                                             wxxx * x, wxxx * y, wxxy * y, wxyy * y, wyyy * y};
      for (size_t i = 0; i < kMoments; ++i) moments_[i][k] += all[i];
      for (size_t i = 0; i < kTerms; ++i) heights_[i][k] += all[i] * height[k];
    }
  }

  Equations equations() const {
    Equations all;
    for (int i = 0; i < kTerms; ++i) {
      for (int j = 0; j <= i; ++j) {
        const size_t power = kPowers[i][1] + kPowers[j][1],
                     degree = kPowers[i][0] + kPowers[j][0] + power;
        all.set(i, j, sum(moments_[degree * (degree + 1) / 2 + power]));
      }
      all.set_right(i, sum(heights_[static_cast<size_t>(i)]));
    }
    return all;
  }

 private:
  static constexpr size_t kMoments = 15;  // of u and v up to the fourth degree, by degree

  static double sum(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

  std::array<Lanes, kMoments> moments_{};
  std::array<Lanes, kTerms> heights_{};
};

double smooth_weight(double squared) {
  const double inner = std::max(1 - squared, 0.0);
  return inner * inner;
}

}  // namespace

double LocalQuadric::above(const Vec3& p) const {
  const Vec3 away = (1 / radius) * (p - origin);
  const Terms row = monomials(dot(away, u), dot(away, v));
  double height = dot(away, normal);
  for (int i = 0; i < kTerms; ++i) height -= terms[i] * row[i];
  return height * radius;
}

Vec3 least_spread(std::span<const Vec3> points) {
  Vec3 middle;
  for (const Vec3& p : points) middle = middle + p;
  middle = (1 / static_cast<double>(points.size())) * middle;
  // Jacobi rotations of the matrix of second moments; `axes` become its eigenvectors.
  double m[3][3]{};
  for (const Vec3& p : points) {
    const Vec3 d = p - middle;
    const double x[3]{d.x, d.y, d.z};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] += x[i] * x[j];
    }
  }
  double axes[3][3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 12; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (m[p][q] == 0) continue;
        const double angle = (m[q][q] - m[p][p]) / (2 * m[p][q]),
                     t = (angle >= 0 ? 1 : -1) / (std::abs(angle) + std::sqrt(angle * angle + 1)),
                     c = 1 / std::sqrt(t * t + 1), s = t * c;
        const auto turn = [&](double& a, double& b) {
          const double old = a;
          a = c * old - s * b;
          b = s * old + c * b;
        };
        for (auto& row : m) turn(row[p], row[q]);
        for (int k = 0; k < 3; ++k) turn(m[p][k], m[q][k]);
        for (auto& row : axes) turn(row[p], row[q]);
      }
    }
  }
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (m[i][i] < m[least][least]) least = i;
  }
  return normalized({axes[0][least], axes[1][least], axes[2][least]});
}

std::optional<LocalQuadric> fit_quadric(std::span<const Vec3> points, const Vec3& origin,
                                        const Vec3& normal, double radius, Weights weights) {
  if (points.size() <= kTerms) return {};
  const auto [u, v] = medial::across(normal);
  LocalQuadric found{origin, u, v, normal, radius};
  Sums sums;
  for (size_t first = 0; first < points.size(); first += Sums::kLanes) {
    Sums::Lanes weight{}, along{}, across{}, height{};
    for (size_t k = 0; k < std::min(Sums::kLanes, points.size() - first); ++k) {
      const Vec3 away = (1 / radius) * (points[first + k] - origin);
      weight[k] = weights == Weights::equal ? 1.0 : smooth_weight(squared_length(away));
      along[k] = dot(away, u);
      across[k] = dot(away, v);
      height[k] = dot(away, normal);
    }
    sums.add(weight, along, across, height);
  }
  Equations equations = sums.equations();
  if (!equations.factorise(kSmallestPivot)) return {};
  found.terms = equations.coefficients(equations.added(equations.right()));
  found.variance = equations.coefficients(equations.added({1}))[0];
  return found;
}

double spread(std::span<const Vec3> points, const LocalQuadric& quadric) {
  double squares = 0;
  for (const Vec3& p : points) {
    const double off = quadric.above(p);
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(points.size() - kTerms));
}

}  // namespace medial
