// SPDX-License-Identifier: GPL-3.0-or-later
// 10,000 small inputs, most of them degenerate: no crash, no broken invariant.
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <set>

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

void expect_sound(const MedialMesh& mesh, std::span<const Vec3> points, int input) {
  ASSERT_EQ(mesh.face_offsets.size(), mesh.generators.size() + 1) << input;
  for (size_t f = 0; f < mesh.generators.size(); ++f) {
    const auto begin = mesh.face_vertices.begin() + mesh.face_offsets[f],
               end = mesh.face_vertices.begin() + mesh.face_offsets[f + 1];
    ASSERT_GE(end - begin, 3) << input;
    ASSERT_EQ(std::set<int32_t>(begin, end).size(), static_cast<size_t>(end - begin)) << input;
    ASSERT_EQ(std::min_element(begin, end), begin) << input;
    const auto [p, q] = mesh.generators[f];
    ASSERT_LT(p, q) << input;
    for (auto v = begin; v != end; ++v) {
      const double r = mesh.radius[*v];
      // Both generators lie on the empty ball, up to the error that circumcentres may have.
      const double scale = r + max_abs(points[p]);
      ASSERT_NEAR(distance(mesh.vertices[*v], points[p]), r, 1e-6 * scale) << input;
      ASSERT_NEAR(distance(mesh.vertices[*v], points[q]), r, 1e-6 * scale) << input;
    }
  }
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    ASSERT_TRUE(std::isfinite(mesh.radius[v]) && std::isfinite(max_abs(mesh.vertices[v]))) << input;
    for (const Vec3& p : points) {
      ASSERT_GE(distance(mesh.vertices[v], p), mesh.radius[v] * (1 - 1e-6) - 1e-9 * max_abs(p))
          << input;
    }
  }
}

// Every edge in an even number of triangles.
void expect_closed(const WatertightSurface& surface, int input) {
  for (const auto& [edge, count] : test::edge_uses(surface.triangles))
    ASSERT_EQ(count % 2, 0) << input;
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
      expect_sound(analysis.extract({.thresholds = {.theta = 0, .rho = 0}}), points, input);
      expect_sound(analysis.extract({.limit_set = true}), points, input);
      analysis.edge_sides();
      if (analysis.tight_cocone()) expect_closed(*analysis.tight_cocone(), input);
    } catch (const DegenerateInputError&) {
      ++degenerate;
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(degenerate, 10);
  EXPECT_LT(degenerate, kInputs / 2);
}

}  // namespace
}  // namespace medial
