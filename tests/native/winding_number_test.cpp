// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/winding_number.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace medial {
namespace {

WindingNumber winding_of(const test::Mesh& mesh) {
  const auto fans = rows_containing(std::span<const Triangle>(mesh.triangles),
                                    static_cast<int32_t>(mesh.vertices.size()));
  return {mesh.vertices, mesh.triangles, boundary_edges(mesh.triangles, fans, {}), nullptr};
}

double brute_force(const test::Mesh& mesh, const Vec3& query) {
  std::vector<Corners> corners;
  for (const auto& [i, j, k] : mesh.triangles)
    corners.push_back({mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]});
  return solid_angle_sum(corners, query);
}

void expect_equal(const test::Mesh& mesh, uint32_t seed) {
  const WindingNumber winding = winding_of(mesh);
  const Vec3 known{0.1, -0.2, 0.3};
  for (const Vec3& query : test::random_points(500, seed)) {
    const double expected = brute_force(mesh, query);
    EXPECT_NEAR(winding(query), expected, 1e-9);
    if (std::abs(expected - 0.5) > 1e-9) {
      EXPECT_EQ(winding.is_inside(query, winding.closed(query)), expected > 0.5);
    }
    EXPECT_EQ(winding.closed_from(known, winding.closed(known), query), winding.closed(query));
  }
}

TEST(WindingNumber, OfAClosedTorusIsTheSumOfSolidAngles) { expect_equal(test::torus(40, 20), 1); }

TEST(WindingNumber, OfAnyTriangleSoupIsTheSumOfSolidAngles) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    test::Mesh mesh{test::random_points(30, seed), {}};
    for (int32_t i = 0; i + 2 < 30; ++i)
      mesh.triangles.push_back({i, (i * 7 + 1) % 30, (i * 11 + 2) % 30});
    expect_equal(mesh, seed + 100);
  }
}

// Rounding leaves a Voronoi vertex that belongs on a face a little beyond it. What is told from
// there is right all the same, however far away.
TEST(WindingNumber, IsToldFromPlacesOnFacesUpToRounding) {
  const test::Mesh box = test::box({0, 0, 0}, {3, 2, 1});
  const WindingNumber winding(box.vertices, box.triangles, {}, nullptr);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.01, 0.99);
  for (int i = 0; i < 300; ++i) {
    Vec3 known{3 * unit(random), 2 * unit(random), unit(random)};
    Vec3 query = known;
    const double far = i % 2 ? 0.5 + unit(random) : 1e16 * unit(random);
    const auto put = [&](double& on, double& beyond, double face) {
      on = std::nextafter(face, face == 0 ? -1 : 4);
      beyond = face == 0 ? -far : face + far;
    };
    if (i % 6 == 0) put(known.x, query.x, 0);
    if (i % 6 == 1) put(known.x, query.x, 3);
    if (i % 6 == 2) put(known.y, query.y, 0);
    if (i % 6 == 3) put(known.y, query.y, 2);
    if (i % 6 == 4) put(known.z, query.z, 0);
    if (i % 6 == 5) put(known.z, query.z, 1);
    EXPECT_EQ(winding.closed_from(known, winding.closed(known), query), 0) << i;
    EXPECT_EQ(winding.closed(query), 0) << i;
  }
}

TEST(RayCrossings, AreToldFromPointsOnTheSurface) {
  const auto mesh = test::torus(40, 20);
  std::vector<Corners> corners;
  for (const auto& [i, j, k] : mesh.triangles) {
    corners.push_back({mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]});
  }
  const RayCrossings crossings(corners, nullptr);
  const Vec3 direction = normalized({0.4267, 0.3181, 0.8466});
  int told = 0, queries = 0;
  for (const auto& [a, b, c] : corners) {
    for (const Vec3& query : {0.5 * (a + b), 0.25 * (a + b) + 0.5 * c, (1.0 / 3) * (a + b + c)}) {
      const auto drop = crossings(query, direction);
      told += drop.has_value();
      ++queries;
      EXPECT_TRUE(!drop || *drop == 0 || *drop == 1);
    }
  }
  EXPECT_GT(told, 0.99 * queries);
}

TEST(SolidAngle, IsComparedAsTheExactSumIs) {
  const auto mesh = test::torus(60, 30);
  std::vector<Corners> corners;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const auto& [i, j, k] = mesh.triangles[t];
    corners.push_back({mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]});
  }
  const SolidAngle angle(corners);
  for (const Vec3& query : test::random_points(300, 4)) {
    const double exact = angle.exact(query);
    for (const double offset : {1.0, 0.1, 1e-3, 1e-6, 1e-9}) {
      EXPECT_TRUE(angle.is_below(exact + offset, query));
      EXPECT_FALSE(angle.is_below(exact - offset, query));
    }
  }
}

TEST(BoundaryEdges, AreTheDirectedEdgesWithoutAPartner) {
  const std::vector<Triangle> quad{{0, 1, 2}, {0, 2, 3}};
  const auto fans = rows_containing(std::span<const Triangle>(quad), 4);
  const auto boundary = boundary_edges(quad, fans, {});
  EXPECT_EQ(boundary, (std::vector<Edge>{{0, 1}, {3, 0}, {1, 2}, {2, 3}}));
}

}  // namespace
}  // namespace medial
