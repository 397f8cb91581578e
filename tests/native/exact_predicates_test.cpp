// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "base/cgal.h"
#include "base/filtered_kernel.h"

namespace medial {
namespace {

using Judge = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Judge::Point_3;

// Five points of a small grid with many digits, often coplanar or cospherical. The last one is
// moved by `nudge` from a plane of the grid.
std::array<Point, 5> five_points(std::mt19937& random, int exponent, double nudge) {
  constexpr double kDigits = 1 + 0x1p-51;  // multiples of it up to 3 have no rounding
  std::uniform_int_distribution<int> of_grid(-3, 3);
  const auto coordinate = [&] { return std::ldexp(kDigits * of_grid(random), exponent); };
  std::array<Point, 5> points;
  for (Point& p : points) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    p = {x, y, z};
  }
  points[4] = {nudge, points[4].y(), points[4].z()};
  return points;
}

TEST(ExactPredicates, HaveTheSignsOfExactNumbers) {
  std::mt19937 random(5);
  int ties = 0;
  for (int i = 0; i < 20000; ++i) {
    const int exponent = std::array{0, -40, -230, 90}[i % 4];
    const double nudge = i % 3 == 0 ? 0 : std::ldexp(i % 2 ? 1 : -1, exponent - i % 131);
    const auto [p, q, r, s, t] = five_points(random, exponent, nudge);
    const auto turn = Judge().orientation_3_object()(p, q, r, t);
    EXPECT_EQ(FilteredKernel::orientation_3_object()(p, q, r, t), turn) << i;
    if (Judge().orientation_3_object()(p, q, r, s) == CGAL::COPLANAR) continue;
    const auto side = Judge().side_of_oriented_sphere_3_object()(p, q, r, s, t);
    EXPECT_EQ(FilteredKernel::side_of_oriented_sphere_3_object()(p, q, r, s, t), side) << i;
    ties += side == CGAL::ON_ORIENTED_BOUNDARY;
  }
  EXPECT_GT(ties, 100);
}

}  // namespace
}  // namespace medial
