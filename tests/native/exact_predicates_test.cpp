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

// Five points of a small grid, often coplanar or cospherical, of which `nudge` moves the last one.
std::array<Point, 5> five_points(std::mt19937& random, int exponent, double nudge) {
  std::uniform_int_distribution<int> of_grid(-3, 3);
  const auto coordinate = [&] { return std::ldexp(of_grid(random), exponent); };
  std::array<Point, 5> points;
  for (Point& p : points) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    p = {x, y, z};
  }
  points[4] = {points[4].x() + nudge, points[4].y(), points[4].z()};
  return points;
}

TEST(ExactPredicates, HaveTheSignsOfExactNumbers) {
  std::mt19937 random(5);
  int ties = 0, nudged = 0;
  for (int i = 0; i < 20000; ++i) {
    const int exponent = std::array{0, -40, -230, 90}[i % 4];
    const double nudge = i % 3 == 0 ? 0 : std::ldexp(i % 2 ? 1 : -1, exponent - i % 49);
    const auto [p, q, r, s, t] = five_points(random, exponent, nudge);
    const auto turn = Judge().orientation_3_object()(p, q, r, t);
    EXPECT_EQ(FilteredKernel::orientation_3_object()(p, q, r, t), turn) << i;
    if (Judge().orientation_3_object()(p, q, r, s) == CGAL::COPLANAR) continue;
    const auto side = Judge().side_of_oriented_sphere_3_object()(p, q, r, s, t);
    EXPECT_EQ(FilteredKernel::side_of_oriented_sphere_3_object()(p, q, r, s, t), side) << i;
    ties += side == CGAL::ON_ORIENTED_BOUNDARY;
    nudged += nudge != 0 && std::ldexp(std::abs(nudge), 30) < std::ldexp(1, exponent);
  }
  EXPECT_GT(ties, 100);
  EXPECT_GT(nudged, 1000);
}

}  // namespace
}  // namespace medial
