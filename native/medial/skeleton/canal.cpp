// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/canal.h"

#include <array>
#include <optional>

namespace medial {
namespace {

// Instead of std::hypot, for which a module would need a newer C library than it may.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

constexpr double kBand = 0.1;  // of the radius: samples nearer to it or farther are other walls
constexpr double kFarthest = 0.05;  // of the radius: more it does not move at once
constexpr double kTooFar = 0.15;    // of the radius: who wants to move so far sees something else
constexpr int kFewest = 12;         // samples
constexpr double kPivot = 1e-9;     // of a column: below, the samples do not tell all unknowns

// For every sample: distance from the axis - radius = r . q + u . (x . q), where q = (1, s, s^2), s
// goes along the tangent, and u is the direction across it. So the unknowns are three of the radius
// and thrice two of the axis: its shift, tilt and curvature.
constexpr int kPowers = 3, kUnknowns = 3 * kPowers;
using Row = std::array<double, kUnknowns>;

// The normal equations. A row of the samples' is (1, u, v) times (1, s, s^2), so that few sums give
// the whole matrix: of the products of the former two times the powers of s.
class Normals {
 public:
  void add(double s, double u, double v, double value, double weight) {
    const std::array<double, 5> power{weight, weight * s, weight * s * s, weight * s * s * s,
                                      weight * s * s * s * s};
    const std::array<double, 6> product{1, u, v, u * u, u * v, v * v};
    for (int i = 0; i < 6; ++i) {
      for (int k = 0; k < 5; ++k) sums_[i][k] += product[i] * power[k];
    }
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < kPowers; ++k) right_[kPowers * i + k] += product[i] * power[k] * value;
    }
  }

  // Means of u and v, and of their products, weighted.
  double mean(int product) const { return sums_[product][0] / sums_[0][0]; }

  // By Cholesky's method; nothing where a column is all but a combination of those before.
  std::optional<Row> solve() const {
    auto m = matrix();
    Row x = right_;
    for (int i = 0; i < kUnknowns; ++i) {
      const double own = m[i][i];
      for (int j = 0; j <= i; ++j) {
        for (int k = 0; k < j; ++k) m[i][j] -= m[i][k] * m[j][k];
        if (j < i) m[i][j] /= m[j][j];
      }
      if (!(m[i][i] > kPivot * own)) return std::nullopt;
      m[i][i] = std::sqrt(m[i][i]);
    }
    for (int i = 0; i < kUnknowns; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= m[i][k] * x[k];
      x[i] /= m[i][i];
    }
    for (int i = kUnknowns; i-- > 0;) {
      for (int k = i + 1; k < kUnknowns; ++k) x[i] -= m[k][i] * x[k];
      x[i] /= m[i][i];
    }
    return x;
  }

 private:
  std::array<Row, kUnknowns> matrix() const {
    constexpr std::array<std::array<int, 3>, 3> kProduct{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
    std::array<Row, kUnknowns> m;
    for (int i = 0; i < kUnknowns; ++i) {
      for (int j = 0; j < kUnknowns; ++j) {
        m[i][j] = sums_[kProduct[i / kPowers][j / kPowers]][i % kPowers + j % kPowers];
      }
    }
    return m;
  }

  std::array<std::array<double, 5>, 6> sums_{};
  Row right_{};
};

double smoothstep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

class Fit {
 public:
  Fit(const PointTree& samples, const Canal& from, double half_width)
      : from_(from), basis_(across(from.tangent)), half_width_(half_width) {
    const double outer = (1 + kBand) * from.radius;
    reach_ = std::sqrt(outer * outer + half_width * half_width);
    samples.visit([&](const Box& box) { return may_meet(box); },
                  [&](int32_t id) { meet(samples[id]); });
  }

  Canal fitted() && {
    Canal canal = from_;
    canal.trust = 0;
    if (met_ < kFewest) return canal;
    canal.trust = all_round();
    if (canal.trust == 0) return canal;
    const auto found = normals_.solve();
    if (!found) {
      canal.trust = 0;
      return canal;
    }
    const auto& f = *found;
    const double size = length(f[3], f[6]) / from_.radius;
    canal.trust *= 1 - smoothstep((size - kFarthest) / (kTooFar - kFarthest));
    const auto part = [&](int i) {
      return canal.trust * (f[i] * basis_[0] + f[i + 3] * basis_[1]);
    };
    canal.centre = from_.centre + (size > kFarthest ? kFarthest / size : 1) * part(3);
    canal.radius = from_.radius + f[0];
    canal.slope = f[1] / half_width_;
    canal.tangent = normalized(from_.tangent + (1 / half_width_) * part(4));
    canal.bend = from_.bend + part(5);
    return canal;
  }

 private:
  bool may_meet(const Box& box) const {
    const Vec3 half = 0.5 * box.extent(), middle = box.centre() - from_.centre, &t = from_.tangent;
    const double along = std::abs(dot(middle, t)),
                 wide = std::abs(half.x * t.x) + std::abs(half.y * t.y) + std::abs(half.z * t.z);
    if (along - wide > half_width_) return false;
    const double size = length(half), inner = (1 - kBand) * from_.radius - size,
                 near = squared_length(middle);
    return near < (reach_ + size) * (reach_ + size) && (inner < 0 || near > inner * inner);
  }

  void meet(const Vec3& sample) {
    const Vec3 to = sample - from_.centre;
    const double s = dot(to, from_.tangent) / half_width_;
    if (!(std::abs(s) < 1)) return;
    const Vec3 beside = to - s * s * from_.bend;
    const double x = dot(beside, basis_[0]), y = dot(beside, basis_[1]), d = length(x, y);
    if (!(std::abs(d - from_.radius) < kBand * from_.radius)) return;
    const double rest = 1 - s * s;
    normals_.add(s, x / d, y / d, d - from_.radius, rest * rest);
    ++met_;
  }

  // Whether samples lie all round, by the directions u: 0 where they lie on two opposite walls, by
  // the lesser principal moment (1/2 on a circle), or all on one side, by their mean.
  double all_round() const {
    const double xx = normals_.mean(3), xy = normals_.mean(4), yy = normals_.mean(5),
                 least = 0.5 * (xx + yy) - length(0.5 * (xx - yy), xy),
                 aside = length(normals_.mean(1), normals_.mean(2));
    return smoothstep((2 * least - 0.3) / 0.4) * (1 - smoothstep((aside - 0.2) / 0.4));
  }

  Canal from_;
  std::array<Vec3, 2> basis_;
  double half_width_, reach_;
  Normals normals_;
  int met_ = 0;
};

}  // namespace

Canal fit_canal(const PointTree& samples, const Canal& from, double half_width) {
  return Fit(samples, from, half_width).fitted();
}

}  // namespace medial
