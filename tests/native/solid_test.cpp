// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of the solid that its surface alone determines: its thickness, its topology, the
// closing of its openings, and the parts of its cells that only the samples have cut off.
#include <gtest/gtest.h>
#include <medial/analysis.h>
#include <medial/sampling.h>

#include "analysis_parts.h"
#include "base/rows.h"
#include "inside/level_set.h"
#include "inside/solid_betti.h"
#include "inside/walls.h"
#include "shapes.h"

namespace medial {
namespace {

using test::box, test::joined, test::turned;

TEST(Walls, AreAsFarAsTheBoxIsThickUpToTheReachAndThroughWhatLiesBetween) {
  const test::Mesh outer = box({0, 0, 0}, {3, 2, 1});
  const std::vector<Vec3> points{{1.1, 0.9, 1}, {1.1, 0.9, 1}, {3, 0.9, 0.3}, {1.1, 0.9, 1}};
  const std::vector<Vec3> normals{{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 0, 0}};
  const std::vector<double> reach{2, 0.9, 4, 2};
  const auto of = [&](const test::Mesh& mesh) {
    return wall_distances(points, normals, reach, mesh.vertices, mesh.triangles, {2});
  };
  const std::vector<double> expected{1, HUGE_VAL, 3, HUGE_VAL};
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_DOUBLE_EQ(of(outer)[i], expected[i]);
    // Another part of the solid ends no way.
    EXPECT_DOUBLE_EQ(of(joined(outer, box({1, 0.5, 0.2}, {1.5, 1.5, 0.5})))[i], expected[i]);
  }
  // A cavity does.
  EXPECT_DOUBLE_EQ(of(joined(outer, turned(box({1, 0.5, 0.2}, {1.5, 1.5, 0.5}))))[0], 0.5);
}

TEST(Walls, AtASlantAreNone) {
  // Down from the slope of a wedge: its foot is 45 degrees off.
  const test::Mesh mesh = box({0, 0, 0}, {1, 1, 1});
  const Vec3 slant = normalized(Vec3{1, 0, 1});
  const auto found = wall_distances(std::vector<Vec3>{{0.9, 0.5, 0.9}}, std::vector<Vec3>{slant},
                                    std::vector<double>{9}, mesh.vertices, mesh.triangles, {1});
  EXPECT_EQ(found[0], HUGE_VAL);
}

std::optional<std::array<int64_t, 3>> betti_of(const test::Mesh& mesh) {
  std::vector<int32_t> own(mesh.vertices.size());
  for (size_t i = 0; i < own.size(); ++i) own[i] = static_cast<int32_t>(i);
  const auto count = static_cast<int32_t>(own.size());
  return solid_betti(make_surface(mesh.triangles, own, count, {2}), mesh.vertices, {2});
}

TEST(SolidBetti, CountsPiecesLoopsAndCavities) {
  using Betti = std::array<int64_t, 3>;
  const test::Mesh ring = test::torus(12, 8), large = box({-4, -4, -4}, {4, 4, 4});
  EXPECT_EQ(betti_of(ring), (Betti{1, 1, 0}));
  EXPECT_EQ(betti_of(large), (Betti{1, 0, 0}));
  EXPECT_EQ(betti_of(joined(large, turned(ring))), (Betti{1, 1, 1}));
  EXPECT_EQ(betti_of(joined(ring, box({5, 5, 5}, {6, 6, 6}))), (Betti{2, 1, 0}));
}

TEST(SolidBetti, IsNotToldByOpenPinchedAndFlatSurfaces) {
  test::Mesh open = test::torus(12, 8);
  open.triangles.pop_back();
  EXPECT_FALSE(betti_of(open));
  test::Mesh pinched = joined(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {2, 2, 2}));
  for (Triangle& t : pinched.triangles) {
    for (int32_t& v : t) v = v == 8 ? 7 : v;  // the corner in which both meet
  }
  EXPECT_FALSE(betti_of(pinched));
  const test::Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_FALSE(betti_of(sheet));
}

TEST(LevelSet, ClosesABoxWithoutItsLidInThePlaneOfThatAndNoOtherOpening) {
  test::Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);
  const auto fans = rows_containing(std::span<const Triangle>(mesh.triangles), 8);
  const auto boundary = boundary_edges(mesh.triangles, fans, {});
  const OpenSurface open(mesh.vertices, mesh.triangles, boundary, nullptr);
  const auto falls = open.falls(0.1, {2});
  // About one line of the lattice per square of a step meets the lid, which has an area of 4.
  EXPECT_GT(falls.size(), 300u);
  EXPECT_LT(falls.size(), 700u);
  // Level and lid part where the solid angle is a half away from the corners of the box.
  double aside = 0;
  for (const auto& fall : falls) {
    const auto place = open.place(fall);
    ASSERT_TRUE(place);
    EXPECT_LT(distance(*place, fall.middle()), 0.02);
    EXPECT_NEAR(open.normal(*place).z, 1, 0.2);
    aside = std::max(aside, std::abs(place->z - 1));
  }
  EXPECT_LT(aside, 1e-4);
}

TEST(LevelSet, OfABentOpeningIsNoneOfItsCaps) {
  test::Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  mesh.triangles.erase(mesh.triangles.begin() + 10, mesh.triangles.end());
  mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);
  const auto fans = rows_containing(std::span<const Triangle>(mesh.triangles), 8);
  const auto boundary = boundary_edges(mesh.triangles, fans, {});
  const OpenSurface open(mesh.vertices, mesh.triangles, boundary, nullptr);
  const auto falls = open.falls(0.1, {2});
  EXPECT_GT(falls.size(), 300u);
  std::vector<Corners> corners;
  for (const auto& [i, j, k] : mesh.triangles) {
    corners.push_back({mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]});
  }
  for (const auto& fall : falls) {
    EXPECT_GT(solid_angle_sum(corners, fall.inside), 0.5);
    EXPECT_LT(solid_angle_sum(corners, fall.outside), 0.5);
    const auto place = open.place(fall);
    ASSERT_TRUE(place);
    EXPECT_NEAR(solid_angle_sum(corners, *place), 0.5, 3e-6);
    EXPECT_LT(distance(*place, fall.middle()), 0.05);
  }
}

// A prism over a triangle with an angle of 35 degrees.
test::Mesh wedge() {
  const double turn = 35 * std::numbers::pi / 180;
  test::Mesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const Vec3& p : {Vec3{}, Vec3{1, 0, 0}, Vec3{std::cos(turn), std::sin(turn), 0}}) {
      mesh.vertices.push_back(p + Vec3{0, 0, z});
    }
  }
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                    {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  return mesh;
}

TEST(Pockets, OfAWedgeAreNoPiecesAndABodyBesideItIs) {
  for (const bool two : {false, true}) {
    // That is smaller than the distance between the samples of the wedge.
    test::Mesh mesh = wedge();
    if (two) mesh = joined(mesh, box({1.05, -0.005, 0.5}, {1.06, 0.005, 0.51}));
    auto points =
        sample_surface(mesh.vertices, mesh.triangles, {.count = 1500, .mirrored_rows = 0}, 2)
            .points;
    const MedialAnalysis analysis(
        {.points = points, .triangles = mesh.triangles, .vertices = mesh.vertices}, {.threads = 2},
        nullptr);
    EXPECT_FALSE(analysis.parts().small.pockets.empty());
    EXPECT_EQ(analysis.hierarchy({}).betti()[0], two ? 2 : 1);
    EXPECT_EQ(analysis.hierarchy({}, Side::inner, 2).betti()[0], two ? 2 : 1);
    EXPECT_EQ(analysis.hierarchy({}, Side::inner, 1).betti()[0], 1);
  }
}

TEST(Pockets, AreNoBodiesThatTouchALargerOneInAnEdge) {
  const test::Mesh mesh = joined(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0.4}, {1.05, 1.05, 0.45}));
  const auto points = sample_surface(mesh.vertices, mesh.triangles, {.count = 1000}, 2).points;
  const MedialAnalysis analysis(
      {.points = points, .triangles = mesh.triangles, .vertices = mesh.vertices}, {.threads = 2},
      nullptr);
  EXPECT_TRUE(analysis.parts().small.pockets.empty());
}

}  // namespace
}  // namespace medial
