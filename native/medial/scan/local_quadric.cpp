// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/local_quadric.h"

#include "base/normal_equations.h"

namespace medial {
namespace {

constexpr int kTerms = 6;
constexpr double kSmallestPivot = 1e-9;  // of a diagonal element: beyond it columns depend
using Equations = NormalEquations<kTerms>;
using Terms = Equations::Terms;

Terms monomials(double u, double v) { return {1, u, v, u * u, u * v, v * v}; }

double smooth_weight(double squared) {
  const double inner = 1 - squared;
  return inner > 0 ? inner * inner : 0;
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
  const auto [u, v] = across(normal);
  LocalQuadric found{origin, u, v, normal, radius};
  Equations equations;
  for (const Vec3& p : points) {
    const Vec3 away = (1 / radius) * (p - origin);
    const double weight = weights == Weights::equal ? 1.0 : smooth_weight(squared_length(away));
    equations.add(monomials(dot(away, u), dot(away, v)), dot(away, normal), weight);
  }
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
