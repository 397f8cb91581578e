// SPDX-License-Identifier: GPL-3.0-or-later
// Crisp places: the feet of points on faces, balls that touch walls, creases, and the axis of a
// box.
#include <gtest/gtest.h>
#include <medial/analysis.h>
#include <medial/sampling.h>

#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <thread>

#include "base/thread.h"
#include "levels/level.h"
#include "shapes.h"
#include "walls/closest_place.h"
#include "walls/convex_creases.h"
#include "walls/least_distance.h"
#include "walls/touching_ball.h"

namespace medial {
namespace {

constexpr double kSharp = 0.53;

test::Mesh box() { return test::box({0, 0, 0}, {3, 2, 1}); }

// A patch over a triangle, bent by its handles.
Patch bent_patch() {
  return {{0, 0, 0},
          {1, 0, 0},
          {0, 1, 0},
          {Vec3{0.3, 0, 0.1}, Vec3{0.7, 0, 0.1}, Vec3{0.7, 0.3, 0.2}, Vec3{0.3, 0.7, 0.2},
           Vec3{0, 0.7, 0.1}, Vec3{0, 0.3, 0.1}}};
}

TEST(Patch, ExpansionHasTheDerivativesOfThePoint) {
  const Patch patch = bent_patch();
  const Barycentric at{0.5, 0.3, 0.2};
  const double step = 1e-4;
  const PatchExpansion e = patch.polynomial({}).expansion(at.b, at.c);
  const auto point = [&](double b, double c) { return patch.point({1 - b - c, b, c}); };
  const auto near = [](const Vec3& a, const Vec3& b) { return distance(a, b) < 1e-6; };
  EXPECT_TRUE(near(e.point, point(0.3, 0.2)));
  EXPECT_TRUE(near(e.b, (0.5 / step) * (point(0.3 + step, 0.2) - point(0.3 - step, 0.2))));
  EXPECT_TRUE(near(e.c, (0.5 / step) * (point(0.3, 0.2 + step) - point(0.3, 0.2 - step))));
  const Vec3 middle = point(0.3, 0.2);
  const double square = 1 / (step * step);
  EXPECT_TRUE(near(e.bb, square * (point(0.3 + step, 0.2) + point(0.3 - step, 0.2) - 2 * middle)));
  EXPECT_TRUE(near(e.cc, square * (point(0.3, 0.2 + step) + point(0.3, 0.2 - step) - 2 * middle)));
  const Vec3 mixed =
      (0.25 * square) * (point(0.3 + step, 0.2 + step) - point(0.3 + step, 0.2 - step) -
                         point(0.3 - step, 0.2 + step) + point(0.3 - step, 0.2 - step));
  EXPECT_TRUE(near(e.bc, mixed));
}

TEST(Patch, IsNowhereNearerThanItsLeastDistance) {
  const Patch patch = bent_patch();
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 x{4 * unit(random) - 2, 4 * unit(random) - 2, 4 * unit(random) - 2};
    double best = HUGE_VAL;
    for (int i = 0; i <= 30; ++i) {
      for (int j = 0; i + j <= 30; ++j) {
        const Vec3 at = patch.point({1 - (i + j) / 30.0, i / 30.0, j / 30.0});
        best = std::min(best, squared_length(at - x));
      }
    }
    EXPECT_LE(least_squared_distance(patch, x), best + 1e-14) << trial;
    EXPECT_GE(least_squared_distance(patch, x), best - 0.15) << trial;
  }
}

// The patch bulges upwards, so points below are nowhere nearer to it than to its flat triangle.
TEST(Patch, BulgesNoWayThatLeadsAwayFromAllPointsOnTheOtherSide) {
  const Patch bent = bent_patch(),
              tilted{{0, 0, 0},
                     {1, 0, 0},
                     {0, 1, 0},
                     {Vec3{0.3, -0.1, 0.1}, Vec3{0.8, 0, 0.1}, Vec3{0.7, 0.4, 0.2},
                      Vec3{0.3, 0.7, -0.05}, Vec3{0, 0.7, 0.1}, Vec3{-0.1, 0.3, 0.1}}};
  EXPECT_LT(bent.bulge({0, 0, 1}), 0.25 * bent.bulge());
  EXPECT_EQ(bent.bulge({0, 0, -1}), bent.bulge());
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 x{4 * unit(random) - 2, 4 * unit(random) - 2, -2 * unit(random)};
    const Barycentric flat = closest_on_flat({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, x);
    const double least = distance(x, {flat.b, flat.c, 0});
    for (const Patch& patch : {bent, tilted}) {
      const Vec3 at = patch.point(closest_on_patch(patch, flat, x));
      EXPECT_GE(distance(x, at), least - patch.bulge({0, 0, 1}) - 1e-14) << trial;
    }
  }
}

TEST(OrientedBox, HoldsItsPointsAndFitsThem) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 normal = normalized({1, 2, 3}), along = across(normal)[0];
  std::vector<Vec3> points;
  for (int i = 0; i < 50; ++i) {
    points.push_back((5 + 2 * unit(random)) * along + unit(random) * cross(normal, along));
  }
  const OrientedBox box = oriented_box(2 * normal, points);
  for (const Vec3& p : points) EXPECT_LT(squared_distance(box, p), 1e-28);
  EXPECT_LT(box.half[0], 1e-14);
  EXPECT_LT(box.half[1], 1.2);
  EXPECT_NEAR(squared_distance(box, box.centre + 3 * normal), 9, 1e-12);
  EXPECT_GT(dot(box.longest_axis(), box.longest_axis()), 0.99);
}

TEST(ClosestPlace, OfAPatchIsNearerThanAnyOtherPlace) {
  const Patch patch = bent_patch();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 x{2 * unit(random) - 0.5, 2 * unit(random) - 0.5, 0.3 * unit(random) - 0.4};
    const Barycentric start = closest_on_flat({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, x);
    const double found = distance(patch.point(closest_on_patch(patch, start, x)), x);
    double best = HUGE_VAL;
    for (int i = 0; i <= 60; ++i) {
      for (int j = 0; i + j <= 60; ++j) {
        best = std::min(best, distance(patch.point({1 - (i + j) / 60.0, i / 60.0, j / 60.0}), x));
      }
    }
    EXPECT_LE(found, best + 1e-12) << trial;
  }
}

TEST(ClosestPlace, OnASideHasAZeroCoordinate) {
  const Barycentric at = closest_on_flat({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, -1, 0});
  EXPECT_EQ(at.c, 0);
  const Barycentric corner = closest_on_patch(bent_patch(), {1, 0, 0}, {-1, -1, 0});
  EXPECT_EQ(corner.a, 1);
}

TEST(Faces, ABallRollsOffOnFaceButNotOverAConvexEdge) {
  const test::Mesh mesh = box();
  const Faces faces({mesh.vertices, mesh.triangles, {}, kSharp}, Frame{}, {});
  // From the bottom the foot of a place near a side wall stays on the bottom.
  const Foot bottom = faces.descend(0, {2.9, 1, 0.4});
  EXPECT_DOUBLE_EQ(bottom.distance, 0.4);
  const auto nearest = faces.nearer({2.9, 1, 0.4}, HUGE_VAL);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->distance, 0.1, 1e-15);
  EXPECT_FALSE(faces.nearer({2.9, 1, 0.4}, 0.09));
}

TEST(TouchingBall, TouchesTwoThreeAndFourWalls) {
  const test::Mesh mesh = box();
  const Faces faces({mesh.vertices, mesh.triangles, {}, kSharp}, Frame{}, {});
  std::array<int32_t, 4> walls{0, 2, 4, 8};  // bottom, top, front, left
  const auto ball = [&](size_t count, const Vec3& start) {
    return touching_ball(faces, {walls.data(), count}, start);
  };
  const TouchingBall two = ball(2, {1.3, 0.9, 0.45});
  EXPECT_NEAR(two.centre.z, 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(two.centre.x, 1.3);  // it moves the shortest way
  const TouchingBall three = ball(3, {1.3, 0.6, 0.45});
  EXPECT_NEAR(three.centre.y, 0.5, 1e-15);
  const TouchingBall four = ball(4, {0.6, 0.6, 0.45});
  EXPECT_LT(distance(four.centre, {0.5, 0.5, 0.5}), 1e-15);
  EXPECT_LT(four.unequal, 1e-15);
}

TEST(ConvexCreases, OfABoxDivideItAndHaveEightCorners) {
  const test::Mesh mesh = box();
  const Faces faces({mesh.vertices, mesh.triangles, {}, kSharp}, Frame{}, {});
  const ConvexCreases creases(faces, 0.05);
  for (int32_t v = 0; v < 8; ++v) EXPECT_TRUE(creases.is_corner(v)) << v;
  const auto place = creases.nearer({1.5, 0.1, 0.2}, HUGE_VAL);
  ASSERT_TRUE(place);
  EXPECT_TRUE(creases.divides(place->edge));
  EXPECT_FALSE(creases.is_jagged(place->edge));
  EXPECT_FALSE(creases.is_fragment(place->edge));
  EXPECT_LT(distance(place->point, {1.5, 0, 0}), 1e-15);
}

TEST(ConvexCreases, OfPatchesBelowTheSpacingDivideNothing) {
  const test::Mesh mesh = box();
  const Faces faces({mesh.vertices, mesh.triangles, {}, kSharp}, Frame{}, {});
  const ConvexCreases creases(faces, 1);
  const auto place = creases.nearer({1.5, 0.1, 0.2}, HUGE_VAL);
  ASSERT_TRUE(place);
  EXPECT_FALSE(creases.divides(place->edge));
}

// A ridge between two large slopes whose line is a zigzag of short edges.
TEST(ConvexCreases, OfAZigzagAreJaggedAndHaveNoCornersInside) {
  test::Mesh mesh;
  const int steps = 40;
  for (int i = 0; i <= steps; ++i) {
    const double x = i, y = i % 2 ? 0.4 : -0.4;
    mesh.vertices.insert(mesh.vertices.end(), {{x, -20, -20}, {x, y, -std::abs(y)}, {x, 20, -20}});
  }
  for (int i = 0; i < steps; ++i) {
    for (const int k : {0, 1}) {
      const int a = 3 * i + k, b = a + 3, c = a + 4, d = a + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  const Faces faces({mesh.vertices, mesh.triangles, {}, kSharp}, Frame{}, {});
  const ConvexCreases creases(faces, 1);
  const auto found = creases.nearer({20, 0, 0}, 2);
  ASSERT_TRUE(found);
  EXPECT_TRUE(creases.is_jagged(found->edge));
  for (int i = 1; i < steps; ++i) EXPECT_FALSE(creases.is_corner(3 * i + 1)) << i;
}

// A plane with one vertex that is lifted, and the sharp edges of the small cone about it.
TEST(ConvexCreases, OfAFewEdgesAreAFragmentWhereSamplesAreNotMuchCloser) {
  test::Mesh mesh;
  const int steps = 12, top = 6 * (steps + 1) + 6;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) mesh.vertices.push_back({double(i), double(k), 0});
  }
  mesh.vertices[top].z = 0.9;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < steps; ++k) {
      const int a = i * (steps + 1) + k, b = a + steps + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  const Faces faces({mesh.vertices, mesh.triangles, {}, kSharp}, Frame{}, {});
  for (const double spacing : {1.0, 0.05}) {
    const ConvexCreases creases(faces, spacing);
    const auto found = creases.nearer({6, 6, 1}, HUGE_VAL);
    ASSERT_TRUE(found);
    EXPECT_EQ(creases.is_fragment(found->edge), spacing == 1) << spacing;
  }
}

// An ellipsoid of revolution with the radii 1 and 0.5, whose axis is a disc of radius 0.75.
test::Mesh oblate() {
  constexpr int kRings = 48, kSides = 96;
  test::Mesh mesh{{{0, 0, 0.5}, {0, 0, -0.5}}, {}};
  for (int r = 1; r < kRings; ++r) {
    const double down = std::numbers::pi * r / kRings;
    for (int i = 0; i < kSides; ++i) {
      const double turn = 2 * std::numbers::pi * i / kSides;
      mesh.vertices.push_back(
          {std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn), 0.5 * std::cos(down)});
    }
  }
  const auto at = [](int ring, int i) { return 2 + (ring - 1) * kSides + i % kSides; };
  for (int i = 0; i < kSides; ++i) {
    mesh.triangles.push_back({0, at(1, i), at(1, i + 1)});
    mesh.triangles.push_back({1, at(kRings - 1, i + 1), at(kRings - 1, i)});
    for (int r = 1; r < kRings - 1; ++r) {
      mesh.triangles.push_back({at(r, i), at(r + 1, i), at(r + 1, i + 1)});
      mesh.triangles.push_back({at(r, i), at(r + 1, i + 1), at(r, i + 1)});
    }
  }
  return mesh;
}

Hierarchy hierarchy_on_faces(const test::Mesh& mesh, int threads) {
  const auto samples =
      sample_surface(mesh.vertices, mesh.triangles, {.count = 3000, .smooth = true});
  const MedialAnalysis analysis({samples.points, mesh.triangles, samples.normals, mesh.vertices},
                                {.threads = threads});
  const FacesInput faces{mesh.vertices, mesh.triangles, samples.triangle, kSharp, {}, true};
  return analysis.hierarchy({}, Side::inner, 1, nullptr, &faces);
}

constexpr LevelOptions kCrisp{.spacings = 1, .round_limbs = true, .relaxed = true, .crisp = true};

// The ball between two smooth walls is found from its feet each time it moves; all faces are
// searched once, at the end. A search takes ten times as long.
TEST(Crisp, PlacesOfSmoothSheetsAreSearchedOnce) {
  const Hierarchy hierarchy = hierarchy_on_faces(oblate(), 2);
  const Faces& faces = *hierarchy.parts().faces;
  const int64_t before = faces.searches();
  const Level level =
      hierarchy.even({.spacings = 1, .round_limbs = true, .crisp = true}).extract(kCrisp);
  const auto touching = std::count(level.place.begin(), level.place.end(), Placing::touching);
  EXPECT_GT(touching, 150);
  // Rims beyond their end are searched on the way, too: 1.15 searches for each place.
  EXPECT_LE(faces.searches() - before, touching + touching / 10);  // 1.07 searches a place
}

}  // namespace
}  // namespace medial
