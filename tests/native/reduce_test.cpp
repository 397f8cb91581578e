// SPDX-License-Identifier: GPL-3.0-or-later
// Small medial meshes: the link condition on random complexes, cones, slabs and balls by sampling.
#include <gtest/gtest.h>
#include <medial/sphere_mesh.h>

#include <random>
#include <set>

#include "base/vec3.h"
#include "reduce/checked_mesh.h"
#include "reduce/collapse.h"
#include "reduce/fit.h"
#include "reduce/sphere_complex.h"

namespace medial {
namespace {

SphereMesh random_mesh(uint32_t seed, int vertices, int triangles, int wires) {
  std::mt19937 random(seed);
  const auto row = [&] { return static_cast<int32_t>(random() % static_cast<uint32_t>(vertices)); };
  const auto share = [&] { return static_cast<double>(random() % 1000) / 1000; };
  SphereMesh mesh;
  for (int i = 0; i < vertices; ++i) {
    mesh.vertices.push_back({share(), share(), share()});
    mesh.radius.push_back(0.1 * share());
  }
  for (int i = 0; i < triangles; ++i) mesh.triangles.push_back({row(), row(), row()});
  for (int i = 0; i < wires; ++i) mesh.wires.push_back({row(), row()});
  return without_doubles(std::move(mesh));
}

// Vertices less edges plus triangles, and components, of those vertices that are there.
std::pair<int64_t, int64_t> counts(const SphereComplex& complex, const std::vector<bool>& there) {
  const auto size = static_cast<int32_t>(there.size());
  int64_t euler = 0, ends = 0, corners = 0;
  std::vector<int32_t> root(there.size());
  for (int32_t v = 0; v < size; ++v) root[v] = v;
  const auto find = [&](int32_t v) {
    while (root[v] != v) v = root[v];
    return v;
  };
  for (int32_t v = 0; v < size; ++v) {
    if (!there[v]) continue;
    ++euler;
    ends += static_cast<int64_t>(complex.neighbours(v).size());
    corners += static_cast<int64_t>(complex.triangles_of(v).size());
    for (const int32_t other : complex.neighbours(v)) root[find(v)] = find(other);
  }
  std::set<int32_t> roots;
  for (int32_t v = 0; v < size; ++v) {
    if (there[v]) roots.insert(find(v));
  }
  return {euler - ends / 2 + corners / 3, static_cast<int64_t>(roots.size())};
}

TEST(SphereComplex, CollapsesKeepEulerCharacteristicAndComponents) {
  int64_t collapses = 0, refused = 0;
  for (uint32_t seed = 0; seed < 200; ++seed) {
    const SphereMesh mesh = random_mesh(seed, 12, 3 + static_cast<int>(seed % 25), 6);
    SphereComplex complex(mesh);
    std::vector<bool> there(mesh.vertices.size(), true);
    const auto before = counts(complex, there);
    for (int32_t a = 0; a < 12; ++a) {
      for (int32_t b = 0; b < 12; ++b) {
        const auto those = complex.neighbours(a);
        if (!std::binary_search(those.begin(), those.end(), b)) continue;
        ASSERT_EQ(complex.can_collapse(a, b), complex.can_collapse(b, a));
        if (!complex.can_collapse(a, b)) {
          ++refused;
          continue;
        }
        complex.collapse(a, b);
        there[b] = false;
        ++collapses;
        ASSERT_EQ(counts(complex, there), before) << seed;
      }
    }
  }
  EXPECT_GT(collapses, 500);
  EXPECT_GT(refused, 100);
}

TEST(Reduce, KeepsWhatIsExactAndWhateverTheThreads) {
  SphereMesh wire;
  for (int i = 0; i <= 30; ++i) {
    wire.vertices.push_back({i / 10.0, 0, 0});
    wire.radius.push_back(0.5 - i / 100.0);
    if (i > 0) wire.wires.push_back({i - 1, i});
  }
  const SphereMesh ends = reduce(wire, {2, 1});
  ASSERT_EQ(ends.vertices.size(), 2u);
  EXPECT_EQ(ends.vertices[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(ends.vertices[1], (Vec3{3, 0, 0}));
  EXPECT_EQ(ends.radius[0], 0.5);
  EXPECT_EQ(ends.radius[1], 0.2);
  const SphereMesh some = random_mesh(7, 60, 80, 20);
  const SphereMesh one = reduce(some, {20, 1}), three = reduce(some, {20, 3});
  EXPECT_EQ(one.vertices, three.vertices);
  EXPECT_EQ(one.triangles, three.triangles);
}

// A round sheet of squares, cut in two, in the plane of x and y; its rim goes in steps.
SphereMesh round_sheet() {
  constexpr int kAcross = 21;
  SphereMesh sheet;
  for (int y = 0; y < kAcross; ++y) {
    for (int x = 0; x < kAcross; ++x) sheet.vertices.push_back({double(x), double(y), 0});
  }
  sheet.radius.assign(sheet.vertices.size(), 0.3);
  for (int32_t y = 0; y + 1 < kAcross; ++y) {
    for (int32_t x = 0; x + 1 < kAcross; ++x) {
      if (std::hypot(x - 9.5, y - 9.5) > 10) continue;
      const int32_t at = y * kAcross + x, up = at + kAcross;
      sheet.triangles.push_back({at, at + 1, up + 1});
      sheet.triangles.push_back({at, up + 1, up});
    }
  }
  return sheet;
}

TEST(Reduce, CollapsesTurnNoTriangleOver) {
  const SphereMesh sheet = round_sheet();
  const SphereComplex complex(sheet);
  const auto places = tangent_places(sheet, complex, {});
  for (const int32_t wanted : {260, 200, 150, 100, 60}) {
    const SphereMesh small = collapse_edges(sheet, complex, places, wanted, {})->mesh;
    for (const auto& [a, b, c] : small.triangles) {
      const Vec3 u = small.vertices[b] - small.vertices[a],
                 v = small.vertices[c] - small.vertices[a];
      EXPECT_GT(cross(u, v).z, 0) << wanted;
    }
  }
}

TEST(Reduce, NoSphereRunsAwayToADistantPlace) {
  SphereMesh ball;
  ball.vertices.push_back({0, 0, 0});
  ball.radius.push_back(0.1);
  const std::vector<TangentPlace> places{{{1, 0, 0}, {1, 0, 0}, 1, {0, -1, -1}}};
  EXPECT_TRUE(fit_spheres(ball, places, {}));
  EXPECT_NEAR(std::hypot(length(ball.vertices[0]), ball.radius[0] - 0.1), 0.05, 1e-9);
  EXPECT_GT(ball.vertices[0].x, 0);
}

TEST(Reduce, SurfaceLiesWhereTheDistanceIsNought) {
  const SphereMesh mesh = random_mesh(3, 12, 6, 5);
  const auto points = solid_surface(mesh, 0.02);
  ASSERT_GT(points.size(), 1000u);
  for (const double distance : solid_distances(points, mesh)) EXPECT_NEAR(distance, 0, 1e-7);
}

}  // namespace
}  // namespace medial
