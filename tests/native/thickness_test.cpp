// SPDX-License-Identifier: GPL-3.0-or-later
// The building blocks of thickness are compared with plain loops.
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <random>

#include "base/nearest_ball.h"
#include "base/patches.h"
#include "cover/ball_reach.h"
#include "shapes.h"

namespace medial {
namespace {

std::vector<Ball> random_balls(int count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  std::vector<Ball> balls;
  for (int i = 0; i < count; ++i) {
    const double x = unit(random), y = unit(random), z = unit(random), r = unit(random);
    balls.push_back({{x, y, z}, r * r * r});
  }
  return balls;
}

int32_t nearest_by_loop(const std::vector<Ball>& balls, const Vec3& query) {
  int32_t best = -1;
  double least = HUGE_VAL;
  for (int32_t i = 0; i < static_cast<int32_t>(balls.size()); ++i) {
    const double away = distance(query, balls[i].centre) - balls[i].radius;
    if (away < least) least = away, best = i;
  }
  return best;
}

TEST(NearestBall, IsThatOfAPlainLoop) {
  for (const int count : {1, 7, 8, 9, 500}) {
    const auto balls = random_balls(count, static_cast<uint32_t>(count));
    const NearestBall nearest(balls);
    for (const Ball& at : random_balls(200, 99)) {
      const Vec3 query = 2 * at.centre - Vec3{0.5, 0.5, 0.5};
      EXPECT_EQ(nearest.find(query), nearest_by_loop(balls, query));
    }
  }
}

TEST(NearestBall, OfEqualOnesIsTheFirst) {
  const std::vector<Ball> balls(30, Ball{{1, 2, 3}, 0.5});
  EXPECT_EQ(NearestBall(balls).find({}), 0);
  EXPECT_EQ(NearestBall({}).find({}), -1);
}

TEST(NeededRadii, AreThoseOfAllPlacesOfATriangle) {
  const std::vector<Vec3> corners{{-0.5, -0.5, 0.5}, {2, 0, 0.5}, {0, 2, 0.5}};
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const auto balls = random_balls(20, 3);
  constexpr double kPiece = 0.01;
  constexpr int kSteps = 400;
  std::vector<double> least(balls.size(), 0);
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const Vec3 place = corners[0] + (double(i) / kSteps) * (corners[1] - corners[0]) +
                         (double(j) / kSteps) * (corners[2] - corners[0]);
      double& most = least[nearest_by_loop(balls, place)];
      most = std::max(most, distance(place, balls[nearest_by_loop(balls, place)].centre));
    }
  }
  const auto radii = needed_radii(balls, corners, triangles, {}, kPiece, {});
  for (size_t b = 0; b < balls.size(); ++b) EXPECT_NEAR(radii[b], least[b], kPiece) << b;
}

}  // namespace
}  // namespace medial
