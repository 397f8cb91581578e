// SPDX-License-Identifier: GPL-3.0-or-later
// The distance of samples to the axis, and the radii round them, against plain loops.
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include "delaunay/edges.h"
#include "delaunay/samples.h"
#include "delaunay/triangulation.h"
#include "delaunay/voronoi.h"
#include "shapes.h"

namespace medial {
namespace {

// Every finite vertex of the facets dual to some edges, those of unbounded facets included.
std::vector<Vec3> facet_vertices(const std::vector<Vec3>& rows, std::span<const Edge> facets) {
  const Samples samples = make_samples(rows, {1, nullptr});
  const Triangulation t = triangulate(samples.points, {1, nullptr});
  const Voronoi v = voronoi(samples.points, t, {1, nullptr});
  const std::set<Edge> wanted(facets.begin(), facets.end());
  std::vector<Vec3> vertices;
  for (int32_t c = 0; c < t.finite_cells; ++c) {
    bool is_wanted = false;
    for (const int32_t a : t.cells[c]) {
      for (const int32_t b : t.cells[c]) {
        is_wanted |= wanted.count({samples.row[a], samples.row[b]}) != 0;
      }
    }
    if (is_wanted) vertices.push_back(v.centre[c]);
  }
  return vertices;
}

// Never below the distance to the nearest vertex, and at most 1/32 above it.
void expect_feature_size(const std::vector<Vec3>& rows, const Thresholds& thresholds) {
  const MedialAnalysis analysis({rows}, {.sides = SidesFrom::none, .threads = 2}, nullptr);
  const auto edges = analysis.edge_rows();
  std::vector<Edge> selected;
  for (const int32_t e : analysis.select({.thresholds = thresholds})) selected.push_back(edges[e]);
  const auto vertices = facet_vertices(rows, selected);
  const auto sizes = analysis.feature_size(thresholds);
  ASSERT_EQ(sizes.size(), rows.size());
  int thinned = 0;
  for (size_t p = 0; p < rows.size(); ++p) {
    double least = HUGE_VAL;
    for (const Vec3& v : vertices) least = std::min(least, distance(v, rows[p]));
    EXPECT_GE(sizes[p], least * (1 - 1e-12));
    EXPECT_LE(sizes[p], least * (1 + 1.0 / 32));
    thinned += sizes[p] > least * (1 + 1e-12);
  }
  EXPECT_GT(thinned, 0) << "too few vertices for a test of the thinning";
  const std::vector<int32_t> some{7, 3, 11};
  const auto at_some = analysis.feature_size(thresholds, some);
  EXPECT_EQ(at_some, (std::vector<double>{sizes[7], sizes[3], sizes[11]}));
}

TEST(FeatureSize, IsTheDistanceToTheAxis) {
  expect_feature_size(test::ellipsoid(3000, 1), {});
  expect_feature_size(test::torus(70, 40).vertices, {});
  expect_feature_size(test::ellipsoid(3000, 2), {.theta = 0.8, .rho = 20});
}

TEST(FeatureSize, IsInfiniteWithoutAnAxis) {
  const auto rows = test::random_points(30, 3);
  const MedialAnalysis analysis({rows}, {.sides = SidesFrom::none}, nullptr);
  for (const double size : analysis.feature_size({.theta = std::numbers::pi / 2, .rho = 1e9})) {
    EXPECT_EQ(size, HUGE_VAL);
  }
}

}  // namespace
}  // namespace medial
