// SPDX-License-Identifier: GPL-3.0-or-later
// Computes sums of squared distances of a sphere (x, y, z, r) to planes that it shall be tangent
// to: the spherical quadrics of Thiery, Guy & Boubekeur (2013), and the slab quadrics of Li et al.
// (2015).
#pragma once

#include <array>
#include <optional>

#include "reduce/cone_and_slab.h"

namespace medial {

class Quadric {
 public:
  // Adds the plane through `point` with the outward unit normal `n`.
  void add_plane(const Vec3& n, const Vec3& point, double weight) {
    const std::array<double, 5> row{n.x, n.y, n.z, 1, -dot(n, point)};
    for (int i = 0, at = 0; i < 5; ++i) {
      for (int j = i; j < 5; ++j, ++at) terms_[at] += weight * row[i] * row[j];
    }
    weight_ += weight;
  }
  Quadric& operator+=(const Quadric& other) {
    for (size_t i = 0; i < terms_.size(); ++i) terms_[i] += other.terms_[i];
    weight_ += other.weight_;
    return *this;
  }

  double weight() const { return weight_; }

  // Returns the sum of weighted squares, which only rounding can make negative.
  double operator()(const Sphere& s) const {
    const std::array<double, 5> m{s.centre.x, s.centre.y, s.centre.z, s.radius, 1};
    double sum = 0;
    for (int i = 0, at = 0; i < 5; ++i) {
      for (int j = i; j < 5; ++j, ++at) sum += (i == j ? 1 : 2) * terms_[at] * m[i] * m[j];
    }
    return sum;
  }

  // Returns the sphere with the least sum; if many have nearly the least, the one nearest to
  // `near`. Returns nothing if rounding hides it.
  std::optional<Sphere> best(const Sphere& near) const {
    constexpr double kPull = 1e-6;  // derived: rounding
    const double pull = kPull * weight_;
    const std::array<double, 4> m{near.centre.x, near.centre.y, near.centre.z, near.radius};
    double a[4][5];
    for (int i = 0, at = 0; i < 4; ++i) {
      for (int j = i; j < 5; ++j, ++at) a[i][j] = terms_[at];
      a[i][i] += pull;
      a[i][4] = pull * m[i] - a[i][4];
    }
    // Elimination of a symmetric positive definite matrix needs no pivots.
    for (int k = 0; k < 4; ++k) {
      if (!(a[k][k] > 0)) return {};
      for (int i = k + 1; i < 4; ++i) {
        const double share = a[k][i] / a[k][k];
        for (int j = i; j < 5; ++j) a[i][j] -= share * a[k][j];
      }
    }
    std::array<double, 4> x{};
    for (int k = 3; k >= 0; --k) {
      double sum = a[k][4];
      for (int j = k + 1; j < 4; ++j) sum -= a[k][j] * x[j];
      x[k] = sum / a[k][k];
    }
    return Sphere{{x[0], x[1], x[2]}, x[3]};
  }

 private:
  std::array<double, 15> terms_{};  // the upper half of a symmetric 5 x 5 matrix, row by row
  double weight_ = 0;
};

}  // namespace medial
