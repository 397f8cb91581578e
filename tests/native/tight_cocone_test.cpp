// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <thread>

#include "delaunay/edges.h"
#include "delaunay/face_set.h"
#include "delaunay/samples.h"
#include "shapes.h"

namespace medial {
namespace {

TEST(FaceSet, ATurnAboutAnEdgeMeetsAllItsTrianglesAndComesBack) {
  const auto points = make_samples(test::random_points(60, 3), {1, nullptr}).points;
  const Triangulation t = triangulate(points, {1, nullptr});
  FaceSet all(t);
  for (int32_t cell = 0; cell < t.cell_count(); ++cell) {
    for (int i = 0; i < 4; ++i) all.insert({cell, i});
  }
  std::vector<int32_t> ring;
  for (int32_t cell = 0; cell < t.finite_cells; ++cell) {
    const CellFace start{cell, 3};
    const auto [p, q, x] = corners(t, start);
    ring_of_cells(t, {p, q}, cell, ring);
    CellFace f = start;
    size_t turns = 0;
    do {
      f = mirror(t, next_about_edge(t, all, f, p, q));
      ++turns;
    } while (!(f == start) && turns <= ring.size());
    EXPECT_EQ(turns, ring.size());
  }
}

TEST(FaceSet, ALonelyTriangleIsItsOwnNeighbour) {
  const auto points = make_samples(test::random_points(60, 4), {1, nullptr}).points;
  const Triangulation t = triangulate(points, {1, nullptr});
  const CellFace lonely{t.finite_cells / 2, 1};
  FaceSet set(t);
  insert_both(t, set, lonely);
  for (const int32_t x : corners(t, lonely)) {
    const auto [p, q] = link_of(corners(t, lonely), x);
    EXPECT_EQ(next_about_edge(t, set, lonely, p, q), mirror(t, lonely));
  }
}

TEST(FaceSet, LinksChainToADiscOnlyWhenEachIsPassedOnce) {
  const auto is_disc = [](std::vector<Edge> links) { return put_in_cycle(links); };
  EXPECT_TRUE(is_disc({{1, 2}, {3, 2}, {1, 3}}));
  EXPECT_TRUE(is_disc({{1, 2}, {4, 3}, {2, 3}, {1, 4}}));
  EXPECT_FALSE(is_disc({}));
  EXPECT_FALSE(is_disc({{1, 2}, {2, 1}}));
  EXPECT_FALSE(is_disc({{1, 2}, {2, 3}}));                                  // open
  EXPECT_FALSE(is_disc({{1, 2}, {2, 3}, {3, 1}, {3, 4}}));                  // a fin
  EXPECT_FALSE(is_disc({{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}}));  // two
  EXPECT_FALSE(is_disc({{1, 2}, {2, 3}, {3, 1}, {3, 4}, {4, 5}, {5, 3}}));  // an eight
}

TEST(TightCocone, AnEmptySolidIsAnErrorOnlyWhereItIsAskedFor) {
  const std::vector<Vec3> corners{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}};
  const MedialAnalysis analysis({corners}, {}, nullptr);
  ASSERT_EQ(analysis.sides_from(), SidesFrom::tight_cocone);
  EXPECT_EQ(analysis.tight_cocone()->inner_cells, 0);
  EXPECT_TRUE(analysis.tight_cocone()->triangles.empty());
  EXPECT_THROW(analysis.extract({.side = Side::inner}), DegenerateInputError);
  EXPECT_THROW(analysis.extract({.side = Side::outer}), DegenerateInputError);
  EXPECT_NO_THROW(analysis.extract({}));
}

TEST(LabelledPoles, KeepACavityThatTightCoconeFills) {
  auto points = test::ellipsoid(6000, 4);
  for (const Vec3& p : test::ellipsoid(2000, 5)) points.push_back(0.5 * p);
  const MedialAnalysis analysis({points}, {.threads = 2});
  EXPECT_EQ(analysis.sides_from(), SidesFrom::poles);
  EXPECT_EQ(analysis.tight_cocone(), nullptr);
  EXPECT_GT(analysis.pole_disagreement().value(), 0.1);
  const MedialMesh axis = analysis.extract({.side = Side::inner});
  EXPECT_GT(axis.generators.size(), 5000u);
  const MedialAnalysis solid({points}, {.sides = SidesFrom::tight_cocone, .threads = 2});
  EXPECT_FALSE(solid.pole_disagreement().has_value());
  // How far outward, from the middle to the outer wall.
  const auto least_height = [](const MedialMesh& mesh) {
    double least = HUGE_VAL;
    for (const Vec3& v : mesh.vertices) least = std::min(least, test::height_in_ellipsoid(v));
    return least;
  };
  EXPECT_GT(least_height(axis), 0.5);
  EXPECT_LT(least_height(solid.extract({.side = Side::inner})), 0.4);
}

}  // namespace
}  // namespace medial
