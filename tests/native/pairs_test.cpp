// SPDX-License-Identifier: GPL-3.0-or-later
// Samples in pairs across thin walls, and the sheets between them.
#include <gtest/gtest.h>
#include <medial/analysis.h>
#include <medial/sampling.h>

#include "sampling/opposite_walls.h"
#include "shapes.h"

namespace medial {
namespace {

constexpr std::array<Triangle, 12> kBoxTriangles{{{0, 2, 1},
                                                  {0, 3, 2},
                                                  {4, 5, 6},
                                                  {4, 6, 7},
                                                  {0, 1, 5},
                                                  {0, 5, 4},
                                                  {1, 2, 6},
                                                  {1, 6, 5},
                                                  {2, 3, 7},
                                                  {2, 7, 6},
                                                  {3, 0, 4},
                                                  {3, 4, 7}}};

class OppositeWallsOfAWedge : public testing::TestWithParam<double> {};

TEST_P(OppositeWallsOfAWedge, TheBallTouchesTheOtherSideOfAWedgeAtTheSameDistanceFromItsEdge) {
  const double angle = GetParam();
  const Vec3 up{std::cos(angle), std::sin(angle), 0};
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {4, 0, 2},
                                 {0, 0, 2}, 4.0 * up,  4.0 * up + Vec3{0, 0, 2}};
  const std::vector<Triangle> sides{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}};
  const TriangleMesh mesh = make_mesh(points, sides, {1, nullptr});
  const Creases creases = find_creases(mesh, 0.5, {}, false, {1, nullptr});
  const CurvedSurface surface(mesh, creases, false, {1, nullptr});
  const OppositeWalls walls(surface, creases);
  const Vec3 from = surface.point(0, {0.3, 0.4, 0.3});
  const auto found = walls({0, {0.3, 0.4, 0.3}}, 4);
  ASSERT_TRUE(found);
  const Vec3 there = surface.point(found->triangle, found->at);
  EXPECT_NEAR(distance(there, from.x * up + Vec3{0, 0, from.z}), 0, 1e-12);
  EXPECT_FALSE(walls({0, {0.3, 0.4, 0.3}}, 0.1 * found->distance));
}

INSTANTIATE_TEST_SUITE_P(Angles, OppositeWallsOfAWedge, testing::Values(0.05, 0.3, 0.8, 1.0));

// The solid is two plates of 0.2, one 0.1 above the other.
TEST(OppositeWalls, AColumnGoesThroughWallsAndGapsInTurn) {
  test::Mesh mesh;
  for (const double up : {0.0, 0.3}) {
    const auto first = static_cast<int32_t>(mesh.vertices.size());
    for (const double z : {up, up + 0.2}) {
      for (const auto& [x, y] :
           {std::pair(0, 0), std::pair(9, 0), std::pair(9, 9), std::pair(0, 9)}) {
        mesh.vertices.push_back({static_cast<double>(x), static_cast<double>(y), z});
      }
    }
    for (const auto& [a, b, c] : kBoxTriangles) {
      mesh.triangles.push_back({a + first, b + first, c + first});
    }
  }
  const TriangleMesh plates = make_mesh(mesh.vertices, mesh.triangles, {1, nullptr});
  const Creases creases = find_creases(plates, 0.5, {}, false, {1, nullptr});
  const CurvedSurface surface(plates, creases, false, {1, nullptr});
  const OppositeWalls walls(surface, creases);
  constexpr std::array<double, 4> expected{0, 0.2, 0.3, 0.5};
  std::vector<ColumnPlace> column;
  for (const double reach : {1.0, 0.45, 0.25}) {
    walls.column({0, {0.4, 0.3, 0.3}}, reach, column);
    std::vector<double> heights;
    for (const ColumnPlace& p : column) {
      heights.push_back(surface.point(p.place.triangle, p.place.at).z);
    }
    ASSERT_EQ(heights.size(), reach == 1.0 ? 4 : reach == 0.45 ? 3 : 1) << reach;
    for (size_t i = 0; i < heights.size(); ++i) {
      EXPECT_NEAR(heights[i], expected[i], 1e-12);
    }
  }
}

}  // namespace
}  // namespace medial
