// SPDX-License-Identifier: GPL-3.0-or-later
// 10,000 small inputs, most of them degenerate, for the sanitizers: no crash. What holds of the
// output is tested by test_fuzz.py.
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include "shapes.h"

namespace medial {
namespace {

std::vector<Vec3> some_points(std::mt19937& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::uniform_real_distribution<double> uniform(-1, 1);
  const int kind = below(6), count = 4 + below(27), size = 2 + below(4);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    const Vec3 real{uniform(random), uniform(random), uniform(random)};
    const Vec3 grid{1.0 * below(size), 1.0 * below(size), 1.0 * below(size)};
    switch (kind) {
      case 0:
        p = real;
        break;
      case 1:
        p = grid;
        break;
      case 2:
        p = {real.x, real.y, 1.0 * below(2)};
        break;  // two layers
      case 3:
        p = normalized(grid - Vec3{0.5, 0.5, 0.5});
        break;  // cospherical
      case 4:
        p = 1e6 * Vec3{1, 1, 1} + 1e-3 * grid;
        break;  // far from the origin
      default:
        p = static_cast<float>(uniform(random)) * normalized(grid);  // rays
    }
  }
  for (int i = below(4); i > 0; --i) points.push_back(points[below(count)]);
  return points;
}

// A sanitizer makes each input take many times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kInputs = 2000;
#else
constexpr int kInputs = 10000;
#endif

TEST(Fuzz, SmallInputs) {
  std::mt19937 random(20261121);
  int degenerate = 0;
  for (int input = 0; input < kInputs; ++input) {
    const auto points = some_points(random);
    std::vector<Triangle> triangles;
    for (int32_t i = 0; i + 2 < static_cast<int32_t>(points.size()) && input % 3 == 0; ++i)
      triangles.push_back({i, i + 1, i + 2});
    try {
      const MedialAnalysis analysis({points, triangles},
                                    {.bounding_sphere = input % 7 == 0, .threads = 1 + input % 2},
                                    nullptr);
      analysis.extract({.thresholds = {.theta = 0, .rho = 0}});
      analysis.extract({.limit_set = true});
      analysis.edge_sides();
    } catch (const DegenerateInputError&) {
      ++degenerate;
    }
  }
  EXPECT_GT(degenerate, 10);
  EXPECT_LT(degenerate, kInputs / 2);
}

}  // namespace
}  // namespace medial
