// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/canal.h"

#include <array>
#include <optional>

#include "base/normal_equations.h"

namespace medial {
namespace {

// This replaces std::hypot, which would require a newer C library than the module may need.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

constexpr double kBand = 0.1;  // of the radius; farther samples are on other walls; chosen: axis
constexpr double kFarthest = 0.05;  // of the radius; no step moves the centre farther; chosen: axis
// share of the radius; a fit that would move so far fits something else
constexpr double kTooFar = 0.15;  // chosen: axis
constexpr double kSteep = 0.7;  // slope from which trust falls; it is 0 at kSteepest; chosen: axis
constexpr int kFewest = 12;     // samples that a fit needs
constexpr double kKept = 0.25;  // share of a cone's curvature that stays at least; chosen: axis
// share of a column; smaller pivots mean that the samples do not determine all unknowns
constexpr double kPivot = 1e-9;  // derived: rounding

// The distance of a sample from the nearest ball of the canal is r . q + u . (x . q), where q = (1,
// t, t^2), t is the place of the ball's centre along the axis, and u is the part across the tangent
// of the direction from there to the sample. A ball a little farther along makes no difference of
// first order, as no ball is nearer. So the unknowns are three for the radius, and three (shift,
// tilt and curvature) for each of the two coordinates of the axis.
constexpr int kPowers = 3, kUnknowns = 3 * kPowers;
using Row = std::array<double, kUnknowns>;

// Holds the normal equations. The row of a sample is (1, u, v) times (1, s, s^2), so few sums give
// the whole matrix: the products of two of the former, times the powers of s.
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

  // Returns the weighted mean of u, v, or one of their products.
  double mean(int product) const { return sums_[product][0] / sums_[0][0]; }

  // Returns nothing if a column is nearly a combination of earlier ones.
  std::optional<Row> solve() const {
    constexpr std::array<std::array<int, 3>, 3> kProduct{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
    NormalEquations<kUnknowns> equations;
    for (int i = 0; i < kUnknowns; ++i) {
      for (int j = 0; j <= i; ++j) {
        const auto& sums = sums_[kProduct[i / kPowers][j / kPowers]];
        equations.set(i, j, sums[i % kPowers + j % kPowers]);
      }
    }
    if (!equations.factorise(kPivot)) return std::nullopt;
    return equations.coefficients(equations.added(right_));
  }

 private:
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
      : from_(from),
        basis_(across(from.tangent)),
        half_width_(half_width),
        slope_(from.slope * half_width),
        flare_(from.flare * half_width * half_width),
        is_cone_(flare_ == 0 && squared_length(from.bend) == 0) {
    const double change = std::abs(slope_) + std::abs(flare_),
                 outer = (1 + kBand) * from.radius + change, aside = length(from.bend);
    along_ = half_width + outer * std::min(1.0, (change + 2 * aside) / half_width);
    reach_ = length(half_width, aside) + outer;
    inner_ = (1 - kBand) * from.radius - change - reach_ + outer;
    samples.visit([&](const Box& box) { return may_meet(box); },
                  [&](const Vec3& sample) { meet(sample); });
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
    canal.slope += f[1] / half_width_;
    canal.trust *= 1 - smoothstep((std::abs(canal.slope) - kSteep) / (kSteepest - kSteep));
    canal.slope = std::clamp(canal.slope, -kSteepest, kSteepest);
    const auto part = [&](int i) {
      return canal.trust * (f[i] * basis_[0] + f[i + 3] * basis_[1]);
    };
    canal.centre = from_.centre + (size > kFarthest ? kFarthest / size : 1) * part(3);
    canal.radius += f[0];
    canal.flare += f[2] / (half_width_ * half_width_);
    canal.tangent = normalized(from_.tangent + (1 / half_width_) * part(4));
    return canal;
  }

 private:
  bool may_meet(const Box& box) const {
    const Vec3 half = 0.5 * box.extent(), middle = box.centre() - from_.centre, &t = from_.tangent;
    const double along = std::abs(dot(middle, t)),
                 wide = std::abs(half.x * t.x) + std::abs(half.y * t.y) + std::abs(half.z * t.z);
    if (along - wide > along_) return false;
    const double size = length(half), inner = inner_ - size, near = squared_length(middle);
    return near < (reach_ + size) * (reach_ + size) && (inner < 0 || near > inner * inner);
  }

  void meet(const Vec3& sample) {
    const Vec3 to = sample - from_.centre;
    const double straight = place_on_cone(to);
    if (!(std::abs(straight) < 1)) return;
    const double t = is_cone_ ? straight : place_on_canal(to, straight);
    const Vec3 out = to - t * half_width_ * from_.tangent - t * t * from_.bend;
    const double d = length(out), away = d - from_.radius - t * (slope_ + t * flare_);
    if (!(std::abs(away) < kBand * from_.radius)) return;
    const double rest = 1 - straight * straight;
    normals_.add(t, dot(out, basis_[0]) / d, dot(out, basis_[1]) / d, away, rest * rest);
    ++met_;
  }

  // Both functions return the place, in half widths, of the ball that is nearest to a sample, where
  // distance - radius is least: the first on the cone that is tangent to the canal, the second on
  // the canal itself, by a step of Newton's method from there.
  double place_on_cone(const Vec3& to) const {
    const double s = dot(to, from_.tangent), d = length(to - s * from_.tangent),
                 slope = from_.slope;
    return (s + slope * d / std::sqrt(1 - slope * slope)) / half_width_;
  }

  double place_on_canal(const Vec3& to, double t) const {
    const Vec3 out = to - t * half_width_ * from_.tangent - t * t * from_.bend,
               way = half_width_ * from_.tangent + 2 * t * from_.bend;
    const double size = length(out), towards = dot(out, way) / size,
                 first = -towards - slope_ - 2 * t * flare_,
                 straight = (squared_length(way) - towards * towards) / size,
                 second = straight - 2 * dot(out, from_.bend) / size - 2 * flare_;
    return t - first / std::max(second, kKept * straight);
  }

  // Returns how evenly the samples surround the axis, from 0 to 1, by their directions u. It is 0
  // if they lie on two opposite walls (the lesser principal moment, 1/2 on a circle, is small) or
  // all on one side (their mean is large).
  double all_round() const {
    const double xx = normals_.mean(3), xy = normals_.mean(4), yy = normals_.mean(5), all = xx + yy,
                 least = (0.5 * all - length(0.5 * (xx - yy), xy)) / all,
                 aside = length(normals_.mean(1), normals_.mean(2)) / std::sqrt(all);
    return smoothstep((2 * least - 0.3) / 0.4) * (1 - smoothstep((aside - 0.2) / 0.4));
  }

  Canal from_;
  std::array<Vec3, 2> basis_;
  double half_width_, slope_, flare_;         // slope_ and flare_ are changes over one half width
  double along_ = 0, reach_ = 0, inner_ = 0;  // bounds on the distances of samples that may count
  bool is_cone_;
  Normals normals_;
  int met_ = 0;
};

}  // namespace

Canal fit_canal(const PointTree& samples, const Canal& from, double half_width) {
  return Fit(samples, from, half_width).fitted();
}

}  // namespace medial
