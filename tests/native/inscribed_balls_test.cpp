// SPDX-License-Identifier: GPL-3.0-or-later
// The largest balls in a solid that touch its faces, compared with a plain loop over all of them.
#include "thickness/inscribed_balls.h"

#include <gtest/gtest.h>

#include "sampling/closest_on_flat.h"
#include "shapes.h"

namespace medial {
namespace {

// A solid between two equal polygons, which are given by triangles and by their outline.
test::Mesh prism(const std::vector<std::array<double, 2>>& outline,
                 const std::vector<Triangle>& front) {
  const auto n = static_cast<int32_t>(outline.size());
  test::Mesh mesh;
  for (const double y : {0.0, 0.8}) {
    for (const auto& [x, z] : outline) mesh.vertices.push_back({x, y, z});
  }
  for (const auto& [a, b, c] : front) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a + n, c + n, b + n});
  }
  for (int32_t i = 0; i < n; ++i) {
    const int32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j + n, j});
    mesh.triangles.push_back({i, i + n, j + n});
  }
  return mesh;
}

std::vector<test::Mesh> solids() {
  return {test::box({0, 0, 0}, {1, 0.7, 0.05}), test::box({0, 0, 0}, {1, 0.7, 0.4}),
          prism({{{0, 0}, {1, 0}, {0.94, 0.34}}}, {{0, 1, 2}}),
          prism({{{0, 0}, {1, 0}, {1, 0.1}, {0.1, 0.1}, {0.1, 0.6}, {0, 0.6}}},
                {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}})};
}

struct Places {
  std::vector<Vec3> points;
  std::vector<int32_t> face;
  std::vector<double> spacing;
};

Places random_places(const test::Mesh& mesh, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.001, 0.999);
  Places places;
  for (int i = 0; i < count; ++i) {
    const auto row = static_cast<int32_t>(random() % mesh.triangles.size());
    const auto& [a, b, c] = mesh.triangles[row];
    const double s = unit(random), t = (1 - s) * unit(random);
    places.points.push_back((1 - s - t) * mesh.vertices[a] + s * mesh.vertices[b] +
                            t * mesh.vertices[c]);
    places.face.push_back(row);
    places.spacing.push_back(0.01);
  }
  return places;
}

Vec3 normal_of(const test::Mesh& mesh, int32_t row) {
  const auto& [a, b, c] = mesh.triangles[row];
  const Vec3& p = mesh.vertices[a];
  return normalized(cross(mesh.vertices[b] - p, mesh.vertices[c] - p));
}

double away(const test::Mesh& mesh, const Triangle& t, const Vec3& from) {
  const Vec3 &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
  const Barycentric at = closest_on_flat(p, q, r, from);
  return distance(from, p + at.b * (q - p) + at.c * (r - p));
}

// Halves an interval until no triangle is inside the ball; those of the place's own plane count
// not.
double diameter_by_loop(const test::Mesh& mesh, const Vec3& point, int32_t row) {
  const Vec3 n = normal_of(mesh, row);
  double low = 0, high = 2;
  for (int i = 0; i < 60; ++i) {
    const double radius = 0.5 * (low + high);
    bool free = true;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (dot(normal_of(mesh, static_cast<int32_t>(t)), n) > 0.999) continue;
      free = free && away(mesh, mesh.triangles[t], point - radius * n) >= radius;
    }
    (free ? low : high) = radius;
  }
  return 2 * low;
}

InscribedBalls measured(const test::Mesh& mesh, const Places& places, bool smooth, int threads) {
  const FacesInput input{mesh.vertices, mesh.triangles, {}, std::numbers::pi / 6, {}, smooth};
  const Run run{threads};
  return inscribed_balls(Faces(input, Frame{}, run, VertexNormals::fitted),
                         {places.points, places.face, places.spacing}, run);
}

TEST(InscribedBalls, AreThoseOfAPlainLoop) {
  for (const test::Mesh& mesh : solids()) {
    const Places places = random_places(mesh, 300);
    const InscribedBalls found = measured(mesh, places, false, 2);
    for (size_t i = 0; i < places.points.size(); ++i) {
      const double truth = diameter_by_loop(mesh, places.points[i], places.face[i]);
      ASSERT_NEAR(found.diameter[i], truth, 1e-6 * truth + 1e-7) << i;
      ASSERT_GE(found.wall[i], found.diameter[i]);
    }
  }
}

// A torus of radii 1 and 0.4 whose rings are turned against each other by a share of a step, so
// that triangles slant.
test::Mesh tube(double turned) {
  const int major = 300, minor = 150;
  const double round = 2 * std::numbers::pi;
  test::Mesh mesh = test::torus(major, minor);
  for (int v = 0; v < major * minor; ++v) {
    const double a = round * (v / minor + turned * (v % minor % 2)) / major,
                 b = round * (v % minor) / minor, r = 1 + 0.4 * std::cos(b);
    mesh.vertices[v] = {r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)};
  }
  return mesh;
}

// A ball in a tube touches faces all round, many of which are beside it and not opposite.
TEST(InscribedBalls, InATubeHaveAWallOppositeEverywhere) {
  for (const double turned : {0.0, 0.5}) {
    const test::Mesh mesh = tube(turned);
    Places places;
    for (size_t t = 0; t < mesh.triangles.size(); t += 37) {
      places.points.push_back(mesh.vertices[mesh.triangles[t][0]]);
      places.face.push_back(static_cast<int32_t>(t));
      places.spacing.push_back(0.03);
    }
    const InscribedBalls found = measured(mesh, places, true, 2);
    for (size_t i = 0; i < places.points.size(); ++i) {
      ASSERT_NEAR(found.diameter[i], 0.8, 1e-3) << i;
      ASSERT_NEAR(found.wall[i], 0.8, 1e-3) << i;
    }
  }
}

TEST(InscribedBalls, ThatHaveNothingOppositeAreInfinite) {
  const test::Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const auto found = measured(sheet, random_places(sheet, 3), true, 1);
  EXPECT_EQ(found.diameter, std::vector<double>(3, HUGE_VAL));
  EXPECT_EQ(found.wall, found.diameter);
}

}  // namespace
}  // namespace medial
