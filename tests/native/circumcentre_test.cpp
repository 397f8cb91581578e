// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/circumcentre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <random>

#include "oracle.h"
#include "shapes.h"

namespace medial {
namespace {

double spread(const Vec3& o, const std::vector<Vec3>& corners) {
  double low = HUGE_VAL, high = 0;
  for (const Vec3& p : corners) {
    low = std::min(low, distance(o, p));
    high = std::max(high, distance(o, p));
  }
  return (high - low) / high;
}

TEST(Circumcentre, ErrorBoundHoldsAgainstAnotherOrderOfTheCorners) {
  for (uint32_t seed = 0; seed < 1000; ++seed) {
    auto p = test::random_points(4, seed);
    p[3] = p[0] + 1e-5 * (p[3] - p[0]);  // a needle
    const Circumcentre one = circumcentre(p[0], p[1], p[2], p[3]),
                       other = circumcentre(p[3], p[1], p[0], p[2]);
    EXPECT_LE(distance(one.centre, other.centre), one.error + other.error) << seed;
  }
}

// Corners with integer coordinates, from fat to flat within one part in 2^40: the true centre is
// known exactly.
void expect_within_error(const std::array<test::GridPoint, 4>& p) {
  if (test::orientation(p[0], p[1], p[2], p[3]) == 0) return;
  const test::Oracle oracle({p.begin(), p.end()}, 1, {{0, 1, 2, 3}});
  const test::Real exact = oracle.centre(0);
  std::array<Vec3, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = {static_cast<double>(p[i].x), static_cast<double>(p[i].y),
                  static_cast<double>(p[i].z)};
  }
  const auto [centre, error] = circumcentre(corners[0], corners[1], corners[2], corners[3]);
  EXPECT_LE(test::length(exact - test::Real{centre.x, centre.y, centre.z}), error);
  EXPECT_LE(error, 1.001 * kCoarsestError * static_cast<double>(oracle.radius(0)) +
                       8 * DBL_EPSILON * (max_abs(corners[3]) + max_abs(centre)));
}

TEST(Circumcentre, IsWithinItsErrorOfTheExactOne) {
  std::mt19937 random(2);
  const auto coordinate = [&](int bits) { return static_cast<int64_t>(random() >> (32 - bits)); };
  for (int i = 0; i < 20000; ++i) {
    const int flatness = 1 + i % 19;
    std::array<test::GridPoint, 4> p;
    for (auto& q : p) q = {coordinate(20), coordinate(20), coordinate(flatness)};
    if (i % 3 == 0) p[3] = p[2] + test::GridPoint{coordinate(3), coordinate(3), 1};  // a needle
    expect_within_error(p);
  }
}

// Four corners of a rotated square: flat but for the rounding of its coordinates.
TEST(Circumcentre, SurvivesTetrahedraThatAreFlatUpToRounding) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int finite = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 n = normalized({uniform(random), uniform(random), uniform(random)});
    const Vec3 u = normalized(cross(n, {0.3, -0.7, 0.2})), v = cross(n, u);
    const Vec3 middle{0.1, 0.2, 0.3};
    const Vec3 a = middle + u, b = middle + v, c = middle - u, d = middle - v;
    const Circumcentre o = circumcentre(a, b, c, d);
    const double r = length(o.centre);
    if (!std::isfinite(r)) continue;  // exactly flat: not a Delaunay cell
    // It lies on the axis of the square, which is one unit wide, however far away.
    EXPECT_LE(length(cross(o.centre - middle, n)), 2 + 1e-9 * r);
    ++finite;
  }
  EXPECT_GT(finite, 500);
}

TEST(Circumcentre, ExactPathAgreesWithAKnownSphere) {
  // Nearly coplanar points of the unit sphere about (3, 4, 5): heights of 2^-40.
  const double h = 0x1p-40, r = std::sqrt(1 - h * h);
  const Vec3 centre{3, 4, 5};
  const Circumcentre o = circumcentre(centre + Vec3{1, 0, 0}, centre + Vec3{0, 1, 0},
                                      centre + Vec3{-1, 0, 0}, centre + Vec3{0, -r, h});
  EXPECT_TRUE(std::isfinite(o.centre.z));
  EXPECT_LT(
      spread(o.centre, {centre + Vec3{1, 0, 0}, centre + Vec3{0, 1, 0}, centre + Vec3{-1, 0, 0}}),
      1e-12);
}

// From fat triangles to needles, of which the exact path takes over: the same direction.
TEST(UnitNormal, TurnsWithItsCorners) {
  std::mt19937 random(3);
  const auto coordinate = [&](int bits) { return static_cast<int64_t>(random() >> (32 - bits)); };
  int exact = 0;
  for (int i = 0; i < 5000; ++i) {
    const test::GridPoint a{coordinate(20), coordinate(20), coordinate(20)};
    const test::GridPoint step{coordinate(4), coordinate(4), coordinate(4)};
    const test::GridPoint tiny{coordinate(1), coordinate(1), coordinate(1)};
    const int64_t far = int64_t{1} << (i % 30);
    const test::GridPoint b = a + far * step, c = a + 2 * far * step + tiny;
    const auto n = test::cross(test::to<test::Wide>(b - a), test::to<test::Wide>(c - a));
    if (n == test::Vector<test::Wide>{0, 0, 0}) continue;
    const auto vec = [](const test::GridPoint& p) {
      return Vec3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
    };
    const auto [direction, error] = unit_normal(vec(a), vec(b), vec(c));
    const test::Real expected = test::unit(test::to<long double>(n));
    const test::Real found{direction.x, direction.y, direction.z};
    EXPECT_LE(test::length(found - expected), error);
    exact += error == 4 * DBL_EPSILON;
  }
  EXPECT_GT(exact, 500);
}

TEST(UnitNormal, OfANeedleIsExact) {
  const Vec3 a{0, 0, 0}, b{1, 1, 0}, c{2, 2, 0x1p-60};
  const Vec3 n = unit_normal(a, b, c).direction;
  EXPECT_NEAR(std::abs(n.x), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(n.x + n.y, 0, 1e-15);
  EXPECT_NEAR(n.z, 0, 1e-15);
  EXPECT_EQ(unit_normal(a, b, b + b).direction, Vec3{});
}

}  // namespace
}  // namespace medial
