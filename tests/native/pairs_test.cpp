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

// A box of 1 x 1 x t in a pose that no axis is parallel to, rounded to float32.
test::Mesh plate(double t) {
  const Vec3 x = normalized(Vec3{2, 1, 0.5}), y = normalized(cross(Vec3{0.3, -1, 2}, x));
  const Vec3 z = cross(x, y);
  test::Mesh mesh{{}, {kBoxTriangles.begin(), kBoxTriangles.end()}};
  for (const double up : {0.0, t}) {
    for (const auto& [u, v] :
         {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      const Vec3 p = static_cast<double>(u) * x + static_cast<double>(v) * y + up * z;
      mesh.vertices.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
  }
  return mesh;
}

// A torus and the same one inside it, of which the tubes are `t` apart.
test::Mesh hollow_torus(double t) {
  test::Mesh mesh = test::torus(64, 32);
  const auto count = static_cast<int32_t>(mesh.vertices.size());
  const auto outer = mesh.triangles;
  TriangleMesh welded = make_mesh(mesh.vertices, mesh.triangles, {2, nullptr});
  std::vector<Vec3> inner(mesh.vertices.size());
  for (size_t p = 0; p < welded.points.size(); ++p) {
    const Vec3 n = normalized(welded.normal_sum(static_cast<int32_t>(p)));
    inner[welded.row[p]] = welded.points[p] - t * n;
  }
  mesh.vertices.insert(mesh.vertices.end(), inner.begin(), inner.end());
  for (const auto& [a, b, c] : outer) mesh.triangles.push_back({a + count, c + count, b + count});
  return mesh;
}

SurfaceSamples paired(const test::Mesh& mesh, int64_t count, bool smooth = false, int threads = 2) {
  SamplingOptions options;
  options.count = count;
  options.pairs = true;
  options.smooth = smooth;
  return sample_surface(mesh.vertices, mesh.triangles, options, threads);
}

// Returns whether each sample names a partner or is named by one.
std::vector<uint8_t> has_partner(const SurfaceSamples& samples) {
  std::vector<uint8_t> has(samples.points.size(), 0);
  for (size_t i = 0; i < has.size(); ++i) {
    if (samples.partner[i] < 0) continue;
    has[i] = has[samples.partner[i]] = 1;
  }
  return has;
}

Level level_of(const test::Mesh& mesh, const SurfaceSamples& samples, bool crisp = false) {
  AnalysisInput input;
  input.points = samples.points;
  input.triangles = mesh.triangles;
  input.vertices = mesh.vertices;
  const auto analysis = MedialAnalysis(input, {});
  FacesInput faces{mesh.vertices, mesh.triangles, samples.triangle};
  const Hierarchy hierarchy =
      analysis.hierarchy({}, Side::inner, std::nullopt, nullptr, &faces, samples.partner);
  LevelOptions options;
  options.spacings = 1;
  options.crisp = crisp;
  return hierarchy.extract(options);
}

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

TEST(Pairs, EverySampleOfAPlateIsOppositeItsPartner) {
  for (const double t : {0.03, 1e-3, 1e-5}) {
    const SurfaceSamples samples = paired(plate(t), 2000);
    const auto has = has_partner(samples);
    EXPECT_EQ(std::count(has.begin(), has.end(), 1), static_cast<int64_t>(has.size())) << t;
    for (size_t i = 0; i < has.size(); ++i) {
      if (samples.partner[i] < 0) continue;
      const double apart = distance(samples.points[i], samples.points[samples.partner[i]]);
      EXPECT_NEAR(apart, t, 0.02 * t + 2e-7);
    }
  }
}

TEST(Pairs, NoPartnerTakesThePlaceOfACorner) {
  const test::Mesh mesh = plate(0.01);
  const SurfaceSamples samples = paired(mesh, 2000);
  for (size_t i = 0; i < samples.points.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      EXPECT_GT(distance(samples.points[i], samples.points[j]), 0.9 * 0.01) << i << " " << j;
    }
  }
}

TEST(Pairs, ThickSolidsAreSampledWithoutPartners) {
  const SurfaceSamples samples = paired(plate(1), 2000);
  EXPECT_EQ(std::count(samples.partner.begin(), samples.partner.end(), -1),
            static_cast<int64_t>(samples.points.size()));
  SamplingOptions options;
  options.count = 2000;
  const test::Mesh cube = plate(1);
  const auto without = sample_surface(cube.vertices, cube.triangles, options, 2).points.size();
  EXPECT_NEAR(static_cast<double>(samples.points.size()), static_cast<double>(without), 40);
}

TEST(Pairs, PartnersOnCurvedWallsAreAlongTheNormals) {
  const SurfaceSamples samples = paired(hollow_torus(0.01), 6000, true);
  const auto has = has_partner(samples);
  EXPECT_GT(std::count(has.begin(), has.end(), 1), 0.99 * static_cast<double>(has.size()));
  for (size_t i = 0; i < has.size(); ++i) {
    if (samples.partner[i] < 0) continue;
    const Vec3 way = normalized(samples.points[i] - samples.points[samples.partner[i]]);
    EXPECT_GT(dot(way, samples.normals[i]), 0.9995);
  }
}

// The smallest spacing is in the middle of no step of a coarse division of the edge.
TEST(Pairs, SamplesOfALongEdgeFollowASmallSpacingNextToLargeOnes) {
  constexpr double kFinest = 0.002, kAt = 0.12;
  const test::Mesh cube = plate(1);
  const Vec3 from = cube.vertices[0], along = cube.vertices[1] - from;
  std::vector<Vec3> sites;
  std::vector<double> spacings;
  for (int i = 0; i <= 100; ++i) {
    sites.push_back(from + 0.01 * i * along);
    spacings.push_back(i == 12 ? kFinest : 0.5);
  }
  SamplingOptions options;
  options.pairs = true;
  options.smooth = false;
  options.sites = sites;
  options.site_spacings = spacings;
  const SurfaceSamples samples = sample_surface(cube.vertices, cube.triangles, options, 2);
  EXPECT_EQ(samples.points, sample_surface(cube.vertices, cube.triangles, options, 1).points);
  std::vector<double> at;
  for (const Vec3& p : samples.points) {
    const double share = dot(p - from, along);
    if (distance(p, from + share * along) < 1e-5) at.push_back(share);
  }
  std::sort(at.begin(), at.end());
  ASSERT_GT(at.size(), 20);
  for (size_t i = 1; i < at.size(); ++i) {
    const double far = std::max(std::abs(at[i] - kAt), std::abs(at[i - 1] - kAt));
    EXPECT_LT(at[i] - at[i - 1], 1.3 * (kFinest + 0.3 * far)) << at[i];
  }
}

TEST(Pairs, AreTheSameForAnyNumberOfThreads) {
  for (const test::Mesh& mesh : {plate(1e-3), hollow_torus(0.02)}) {
    const SurfaceSamples one = paired(mesh, 3000, false, 1), four = paired(mesh, 3000, false, 4);
    EXPECT_EQ(one.points, four.points);
    EXPECT_EQ(one.partner, four.partner);
  }
}

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

TEST(Pairs, PartnersHaveToFitThePoints) {
  const test::Mesh mesh = plate(0.01);
  SurfaceSamples samples = paired(mesh, 500);
  samples.partner.pop_back();
  EXPECT_THROW(level_of(mesh, samples), InvalidInputError);
  samples.partner.push_back(static_cast<int32_t>(samples.points.size()));
  EXPECT_THROW(level_of(mesh, samples), InvalidInputError);
}

}  // namespace
}  // namespace medial
