// SPDX-License-Identifier: GPL-3.0-or-later
// The methods that the paper compares itself with, by brute force on some dozens of points.
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <set>

#include "axis/poles.h"
#include "delaunay/samples.h"
#include "delaunay/triangulation.h"
#include "delaunay/voronoi.h"
#include "rivals/power_shape.h"
#include "rivals/rival_axes.h"
#include "shapes.h"

namespace medial {
namespace {

double diagonal(const std::vector<Vec3>& points) {
  Box box;
  for (const Vec3& p : points) box.add(p);
  return length(box.extent());
}

std::vector<uint8_t> chosen(const MedialAnalysis& analysis, const SizeExtraction& extraction) {
  std::vector<uint8_t> flags(analysis.edge_rows().size(), 0);
  for (const int32_t id : select_by_size(analysis, extraction)) flags[id] = 1;
  return flags;
}

TEST(Rivals, LambdaReachesTheLength) {
  const auto points = test::ellipsoid(60, 3);
  const MedialAnalysis analysis({.points = points}, {.sides = SidesFrom::none});
  const auto edges = analysis.edge_rows();
  for (const Edge& limit : edges) {
    const double share = distance(points[limit[0]], points[limit[1]]) / diagonal(points);
    const auto flags = chosen(analysis, {.length = share});
    for (size_t e = 0; e < edges.size(); ++e) {
      const double size = distance(points[edges[e][0]], points[edges[e][1]]);
      EXPECT_EQ(flags[e] != 0, size >= share * diagonal(points));
    }
  }
}

// The least angle under which a ball at a vertex of the facet of pq sees the two; 0 at infinity.
double least_angle(const std::vector<Vec3>& points, const Edge& pq) {
  const Samples samples = make_samples(points, {});
  const Triangulation t = triangulate(samples.points, {});
  const Voronoi v = voronoi(samples.points, t, {});
  const int32_t p = samples.point_of_row[pq[0]], q = samples.point_of_row[pq[1]];
  double least = std::numbers::pi;
  for (int32_t c = 0; c < t.cell_count(); ++c) {
    const Cell& cell = t.cells[c];
    if (std::count(cell.begin(), cell.end(), p) + std::count(cell.begin(), cell.end(), q) < 2) {
      continue;
    }
    if (t.is_infinite(c)) return 0;
    const Vec3 a = samples.points[p] - v.centre[c], b = samples.points[q] - v.centre[c];
    least = std::min(least, std::atan2(length(cross(a, b)), dot(a, b)));
  }
  return least;
}

TEST(Rivals, AngleAndLengthAskEveryBall) {
  const auto points = test::ellipsoid(40, 5);
  const MedialAnalysis analysis({.points = points}, {.sides = SidesFrom::none});
  const auto edges = analysis.edge_rows();
  int kept = 0;
  for (const double length : {0.0, 0.3}) {
    const auto flags = chosen(analysis, {SizeCondition::angle_and_length, length, 0.4});
    for (size_t e = 0; e < edges.size(); ++e) {
      const double size = distance(points[edges[e][0]], points[edges[e][1]]);
      const bool expected =
          least_angle(points, edges[e]) >= 0.8 && size >= length * diagonal(points);
      EXPECT_EQ(flags[e] != 0, expected);
      kept += expected;
    }
  }
  EXPECT_GT(kept, 10);
}

TEST(Rivals, PolesAreTheFarthestVerticesOfCells) {
  const auto points = test::ellipsoid(80, 7);
  const Samples samples = make_samples(points, {});
  const Triangulation t = triangulate(samples.points, {});
  const Voronoi v = voronoi(samples.points, t, {});
  const Poles first = poles(samples.points, t, v, incident_cells(t, samples.count(), {}), {});
  std::set<std::array<double, 3>> expected;
  for (int32_t p = 0; p < samples.count(); ++p) {
    for (const double sign : {1.0, -1.0}) {
      if (sign > 0 && first.unbounded[p]) continue;
      Vec3 pole = samples.points[p];
      for (int32_t c = 0; c < t.finite_cells; ++c) {
        const Vec3 to = v.centre[c] - samples.points[p];
        if (std::count(t.cells[c].begin(), t.cells[c].end(), p) == 0) continue;
        if (sign * dot(to, first.vector[p]) <= 0) continue;
        if (length(to) > distance(pole, samples.points[p])) pole = v.centre[c];
      }
      if (pole != samples.points[p]) expected.insert({pole.x, pole.y, pole.z});
    }
  }
  const MedialMesh found =
      pole_axis(MedialAnalysis({.points = points}, {.sides = SidesFrom::none}));
  std::set<std::array<double, 3>> places;
  for (const Vec3& x : found.vertices) places.insert({x.x, x.y, x.z});
  EXPECT_EQ(places, expected);
  EXPECT_EQ(places.size(), found.vertices.size());
  EXPECT_TRUE(found.generators.empty());
}

TEST(Rivals, RefuseWhatMeansNothing) {
  const auto points = test::ellipsoid(60, 3);
  const MedialAnalysis analysis({.points = points}, {.sides = SidesFrom::none});
  EXPECT_THROW(axis_by_size(analysis, {.length = -1}), InvalidInputError);
  EXPECT_THROW(axis_by_size(analysis, {.side = Side::inner}), InvalidInputError);
  EXPECT_THROW(axis_by_remark(analysis, Against::pole, {.side = Side::inner}), InvalidInputError);
  EXPECT_THROW(pole_axis(analysis, Side::crossing), InvalidInputError);
}

TEST(PowerShape, HasNoHiddenBalls) {
  const std::vector<Vec3> centres = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, 1}};
  const std::vector<uint8_t> all(5, 1), three = {1, 1, 1, 0, 1};
  const std::vector<double> large = {4, 4, 4, 4, 0.1}, equal(5, 1.0);
  const PowerShape hidden = power_shape(centres, large, all);
  EXPECT_EQ(hidden.balls, (Column<int32_t>{0, 1, 2, 3}));
  EXPECT_EQ(hidden.triangles, (Column<Triangle>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}));
  EXPECT_TRUE(hidden.edges.empty());
  EXPECT_EQ(power_shape(centres, large, three).triangles, (Column<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(power_shape(centres, equal, all).triangles.size(), 10u);
}

}  // namespace
}  // namespace medial
