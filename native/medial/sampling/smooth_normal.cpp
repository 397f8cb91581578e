// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/smooth_normal.h"

#include "base/normal_equations.h"

namespace medial {
namespace {

// Slope, curvature as of a sphere, two terms more of a quadric, four of a cubic.
constexpr int kSlopes = 2, kQuadric = 5, kTerms = 9;
using Terms = std::array<double, kTerms>;
// So little is every curvature and cubic term held back, which decides them where the points do
// not.
constexpr double kHeldBack = 1e-9;  // derived: rounding
// A surface of more terms counts fully if the mean square of what it leaves is at most the first
// share of what one of fewer terms leaves, and not at all from the second share on. With noise
// alone both are about the same. Without a slope between them the two walls of a thin part would
// differ where one is on this side of a limit and the other on that.
constexpr double kMuchBetter = 0.01, kNoBetter = 0.1;  // chosen: unseen

// Returns the terms for a point at (u, v) along the plane, at a squared distance. On every sphere
// the height is a slope and a multiple of the squared distance, which makes these exact.
Terms terms(double u, double v, double squared) {
  return {u, v, squared, u * u - v * v, 2 * u * v, u * u * u, u * u * v, u * v * v, v * v * v};
}

// A fit of heights in which later terms add to the earlier ones.
class Fit {
 public:
  void add(const Terms& row, double height, double weight) {
    equations_.add(row, height, weight);
    heights_ += weight * height * height;
  }
  // Returns whether the points determine the slope.
  bool solve() {
    const double least = kHeldBack * equations_.square(kSlopes);
    for (int i = kSlopes; i < kTerms; ++i) equations_.hold_back(i, least);
    if (!equations_.factorise(0)) return false;
    added_ = equations_.added(equations_.right());
    return true;
  }
  // Returns the weighted mean square that the first terms leave of the heights of some points.
  double left_by(int terms, int points) const {
    double left = heights_;
    for (int i = 0; i < terms; ++i) left -= added_[i] * added_[i];
    return std::max(left, 0.0) / (points - terms);
  }
  // Returns the surface of the first terms.
  Terms surface(int terms) const { return equations_.coefficients(added_, terms); }

 private:
  NormalEquations<kTerms> equations_;
  Terms added_{};
  double heights_ = 0;  // the weighted sum of squares
};

// Returns how far a surface of more terms counts, between 0 and 1.
double weight_of(double left, double by_fewer) {
  if (!(by_fewer > 0)) return 0;
  return std::clamp((kNoBetter - left / by_fewer) / (kNoBetter - kMuchBetter), 0.0, 1.0);
}

Vec3 between(const Vec3& from, const Vec3& to, double share) {
  return normalized((1 - share) * from + share * to);
}

}  // namespace

// The error of a cubic surface grows as the fourth power of the distance; weights that fall as its
// third power leave enough to the far points, which determine the cubic terms.
Vec3 smooth_normal(const Vec3& here, std::span<const Vec3> around, const TriangleNormals& of) {
  const auto count = static_cast<int>(around.size());
  if (count <= kQuadric) return of.by_angle;
  double squares = 0;
  for (const Vec3& p : around) squares += squared_length(p - here);
  const double scale = std::sqrt(count / squares);
  const auto plane = across(of.of_sphere);
  const Vec3 &u = plane[0], &v = plane[1];
  Fit fit;
  for (const Vec3& p : around) {
    const Vec3 away = scale * (p - here);
    const double squared = squared_length(away);
    fit.add(terms(dot(away, u), dot(away, v), squared), dot(away, of.of_sphere),
            1 / (squared * squared * squared));
  }
  if (!fit.solve()) return of.by_angle;
  const double by_quadric = fit.left_by(kQuadric, count),
               bent = weight_of(by_quadric, fit.left_by(kSlopes, count));
  const auto normal_of = [&](int terms) {
    const Terms found = fit.surface(terms);
    return normalized(of.of_sphere - found[0] * u - found[1] * v);
  };
  const Vec3 mean = between(of.by_angle, normal_of(kQuadric), bent);
  if (count <= kTerms) return mean;
  return between(mean, normal_of(kTerms), bent * weight_of(fit.left_by(kTerms, count), by_quadric));
}

}  // namespace medial
