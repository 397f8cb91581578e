// SPDX-License-Identifier: GPL-3.0-or-later
// Poisson discs from below and from above: how near they come to each other, and how wide the holes
// are that they leave; where the spacing is even and where it changes. And the rows beside sharp
// edges, which are placed before them.
#include <gtest/gtest.h>
#include <medial/sampling.h>

#include <random>

#include "sampling/mirrored_rows.h"
#include "sampling/poisson_disk.h"
#include "shapes.h"

namespace medial {
namespace {

// A mesh and what is sampled on it.
struct Sampled {
  TriangleMesh mesh;
  Creases creases;
  CurvedSurface surface;

  explicit Sampled(const test::Mesh& from)
      : mesh(make_mesh(from.vertices, from.triangles, {2, nullptr})),
        creases(find_creases(mesh, 2, {}, false, {2, nullptr})),
        surface(mesh, creases, false, {2, nullptr}) {}
  Sampled(const Sampled&) = delete;

  std::vector<PlacedDisk> disks(const Spacing& spacing, double scale, uint64_t seed) const {
    const auto pieces = cut_into_pieces(surface, spacing.field ? 0 : 2, spacing, {2, nullptr});
    return poisson_disks(surface, pieces, scale, {}, 14, seed, {2, nullptr});
  }
  // Places spread over all triangles, more than there are discs.
  std::vector<Vec3> places(int per_triangle, uint32_t seed) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Vec3> found;
    for (int32_t t = 0; t < static_cast<int32_t>(mesh.triangles.size()); ++t) {
      for (int i = 0; i < per_triangle; ++i) {
        double b = uniform(random), c = uniform(random);
        if (b + c > 1) b = 1 - b, c = 1 - c;
        found.push_back(surface.point(t, {1 - b - c, b, c}));
      }
    }
    return found;
  }
};

test::Mesh square(double side) {
  return {{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += length(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
  }
  return area;
}

void expect_blue_noise(const test::Mesh& from, double radius, uint64_t seed) {
  const Sampled sampled(from);
  const auto disks = sampled.disks({radius}, 1, seed);
  for (size_t i = 0; i < disks.size(); ++i) {
    EXPECT_EQ(disks[i].disk.radius, radius);
    double nearest = HUGE_VAL;
    for (size_t j = 0; j < disks.size(); ++j) {
      if (j == i || dot(disks[i].disk.normal, disks[j].disk.normal) <= 0) continue;
      nearest = std::min(nearest, distance(disks[i].disk.centre, disks[j].disk.centre));
    }
    EXPECT_GE(nearest, radius);
    EXPECT_LT(nearest, 2 * radius);  // between them one more would have room
  }
  double hole = 0;
  for (const Vec3& place : sampled.places(10000 / static_cast<int>(from.triangles.size()), 1)) {
    double nearest = HUGE_VAL;
    for (const PlacedDisk& d : disks) nearest = std::min(nearest, distance(d.disk.centre, place));
    hole = std::max(hole, nearest);
  }
  EXPECT_LT(hole, 1.3 * radius);
  const double packing =
      static_cast<double>(disks.size()) * radius * radius / area_of(sampled.mesh);
  EXPECT_NEAR(packing, kPacking, 0.08 * kPacking);  // at the rim of a surface it is denser
}

TEST(BlueNoise, LeavesNoHolesAndComesNoNearerThanItsRadius) {
  for (uint64_t seed = 0; seed < 3; ++seed) {
    expect_blue_noise(square(1), 0.02, seed);
    expect_blue_noise(test::torus(30, 15), 0.09, seed);
  }
}

// Where the spacing changes the smaller of two radii counts: nothing is nearer than that, but many
// pairs are nearer than the larger one, and no hole is wider than the radius there allows.
TEST(BlueNoise, OfTwoRadiiTheSmallerCounts) {
  std::vector<Vec3> sites;
  std::vector<double> spacings;
  for (int i = 0; i <= 64; ++i) {
    for (int j = 0; j <= 64; ++j) {
      sites.push_back({i / 64.0, j / 64.0, 0});
      spacings.push_back(0.008 + 0.05 * i / 64);
    }
  }
  const SizingField field(sites, spacings, {2, nullptr});
  const Sampled sampled(square(1));
  const auto disks = sampled.disks({1, &field}, 1, 3);
  ASSERT_GT(disks.size(), 500u);
  int between = 0, pairs = 0;
  for (size_t i = 0; i < disks.size(); ++i) {
    const Disk& a = disks[i].disk;
    EXPECT_NEAR(a.radius, 0.008 + 0.05 * a.centre.x, 0.3 * a.radius);
    for (size_t j = 0; j < i; ++j) {
      const Disk& b = disks[j].disk;
      const double away = distance(a.centre, b.centre);
      EXPECT_GE(away, std::min(a.radius, b.radius));
      between += away < std::max(a.radius, b.radius);
      pairs += away < 1.5 * std::max(a.radius, b.radius);
    }
  }
  EXPECT_GT(between, pairs / 20);
  for (const Vec3& place : sampled.places(4000, 2)) {
    double nearest = HUGE_VAL;  // in radii of the disc
    for (const PlacedDisk& d : disks) {
      nearest = std::min(nearest, distance(d.disk.centre, place) / d.disk.radius);
    }
    EXPECT_LT(nearest, 1.35);
  }
}

SurfaceSamples samples_of(const test::Mesh& mesh, double spacing, int rows, double angle = 0.5) {
  SamplingOptions options;
  options.spacing = spacing;
  options.mirrored_rows = rows;
  options.sharp_angle = angle;
  return sample_surface(mesh.vertices, mesh.triangles, options, 2);
}

TEST(MirroredRows, LieAtTheSamePlacesOnBothSidesOfASharpEdge) {
  const double spacing = 0.08;
  const auto samples = samples_of(test::folded(), spacing, 2);
  for (const double row : {0.75, 1.6}) {
    std::set<long> left, right;  // along the edge, in millionths
    for (const Vec3& p : samples.points) {
      if (std::abs(std::max(p.x, p.z) - row * spacing) > 1e-9) continue;
      (p.z == 0 ? left : right).insert(std::lround(1e6 * p.y));
    }
    EXPECT_EQ(left, right);
    // 25 steps of one spacing; next to the ends of the edge there is no room.
    EXPECT_GE(left.size(), 21u);
    EXPECT_LE(left.size(), 25u);
  }
  int between = 0;
  for (const Vec3& p : samples.points) {
    const double away = std::max(p.x, p.z);
    between += away > 0 && away < 1.5 * spacing && std::abs(away - 0.75 * spacing) > 1e-9;
  }
  EXPECT_LT(between, 8);  // discs at the ends of the edge
}

// Rows, edges and discs between them keep the distance of discs; seen from one side of the edge.
TEST(MirroredRows, KeepTheirDistance) {
  for (const double spacing : {0.08, 0.093, 0.11}) {
    const auto samples = samples_of(test::folded(), spacing, 3);
    double nearest = HUGE_VAL;
    for (size_t i = 0; i < samples.points.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        const Vec3 &a = samples.points[i], &b = samples.points[j];
        const bool one_side = (a.x == 0 && b.x == 0) || (a.z == 0 && b.z == 0);
        if (one_side) nearest = std::min(nearest, distance(a, b));
      }
    }
    EXPECT_GE(nearest, 0.726 * spacing);
    EXPECT_LT(nearest, 0.8 * spacing);
  }
}

TEST(MirroredRows, TheEdgeItselfIsSampledAtEvenSteps) {
  const auto samples = samples_of(test::folded(), 0.13, 0);
  std::vector<double> along;
  for (size_t i = 0; i < samples.points.size(); ++i) {
    const bool on_edge = samples.points[i].x == 0 && samples.points[i].z == 0;
    if (on_edge) along.push_back(samples.points[i].y);
    EXPECT_EQ(on_edge && along.back() > 0 && along.back() < 2,
              samples.kind[i] == SampleKind::sharp);
  }
  std::sort(along.begin(), along.end());
  ASSERT_EQ(along.size(), 17u);  // 16 parts of 0.125
  for (size_t i = 0; i < 17; ++i) EXPECT_NEAR(along[i], 0.125 * static_cast<double>(i), 1e-12);
}

// On a plane a walk goes straight on over the edges that it crosses.
TEST(WalkFromEdge, GoesStraightOverAPlane) {
  test::Mesh plane;
  const auto noise = test::random_points(121, 3);
  for (int i = 0; i < 121; ++i) {
    const bool rim = i % 11 % 10 == 0 || i / 11 % 10 == 0;
    const Vec3 shift = rim ? Vec3{} : Vec3{0.03 * noise[i].x, 0.03 * noise[i].y, 0};
    plane.vertices.push_back(Vec3{0.1 * (i % 11), 0.1 * (i / 11), 0} + shift);
  }
  for (int i = 0; i < 110; ++i) {
    if (i % 11 == 10) continue;
    plane.triangles.push_back({i, i + 1, i + 12});
    plane.triangles.push_back({i, i + 12, i + 11});
  }
  const Sampled sampled(plane);
  int walks = 0;
  for (const MeshEdge& edge : sampled.creases.edges) {
    const Vec3 &p = sampled.mesh.points[edge.ends[0]], &q = sampled.mesh.points[edge.ends[1]];
    const Vec3 along = normalized(q - p);
    for (const int32_t triangle : edge.triangles) {
      if (triangle < 0) continue;
      Vec3 third;
      for (const int32_t v : sampled.mesh.triangles[triangle]) {
        if (v != edge.ends[0] && v != edge.ends[1]) third = sampled.mesh.points[v];
      }
      const Vec3 side = third - p, into = normalized(side - dot(side, along) * along);
      const Vec3 goal = 0.7 * p + 0.3 * q + 0.21 * into;
      const auto found = walk_from_edge(sampled.mesh, sampled.creases, edge, triangle, 0.3, 0.21);
      const bool beyond = std::min(goal.x, goal.y) < 0 || std::max(goal.x, goal.y) > 1;
      ASSERT_EQ(found.has_value(), !beyond);
      if (!found) continue;
      EXPECT_LT(distance(sampled.surface.point(found->triangle, found->at), goal), 1e-12);
      ++walks;
    }
  }
  EXPECT_GT(walks, 300);
}

TEST(MirroredRows, AWalkAlongASideGoesStraightOn) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {2, 4, 5}, {0, 2, 5}};
  const TriangleMesh mesh = make_mesh(points, triangles, {1, nullptr});
  const Creases creases = find_creases(mesh, 1, {}, false, {1, nullptr});
  const int32_t edge = creases.find(0, 1);
  for (const double distance_walked : {0.5, 1.5}) {
    const auto found = walk_from_edge(mesh, creases, creases.edges[edge], 0, 1.0, distance_walked);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->at.a + found->at.b + found->at.c, 1, 1e-12);
    const CurvedSurface surface(mesh, creases, false, {1, nullptr});
    const Vec3 goal{1, distance_walked, 0};
    EXPECT_LT(distance(surface.point(found->triangle, found->at), goal), 1e-12);
  }
}

// A fold that goes straight on past a vertex where a third crease begins has a corner there.
TEST(Creases, WhereThreeMeetIsACorner) {
  const test::Mesh mesh{{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {1, 1, 0}, {-0.1, 0, 1}, {-0.9, 2, 0.9}},
                        {{0, 3, 1}, {1, 3, 2}, {0, 1, 4}, {1, 2, 5}, {1, 5, 4}}};
  const auto welded = make_mesh(mesh.vertices, mesh.triangles, {1, nullptr});
  const Creases creases = find_creases(welded, 0.2, {}, false, {1, nullptr});
  for (const auto& [p, q] : {Edge{0, 1}, Edge{1, 2}, Edge{1, 5}}) {
    EXPECT_EQ(creases.edges[creases.find(p, q)].crease, Crease::sharp);
  }
  EXPECT_TRUE(creases.corner[1]);
}

// Three triangles at an edge, or two that pass it in one direction: not clear which two sides join.
TEST(Creases, AreSharpWhereSidesDoNotJoin) {
  test::Mesh mesh = square(1);
  mesh.vertices.push_back({0.5, 0.5, 1});
  mesh.triangles.push_back({0, 2, 4});
  const auto three = make_mesh(mesh.vertices, mesh.triangles, {1, nullptr});
  const Creases at_three = find_creases(three, 3, {}, false, {1, nullptr});
  EXPECT_EQ(at_three.edges[at_three.find(0, 2)].crease, Crease::sharp);
  mesh = square(1);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  const auto flipped = make_mesh(mesh.vertices, mesh.triangles, {1, nullptr});
  const Creases at_flipped = find_creases(flipped, 3.2, {}, false, {1, nullptr});
  EXPECT_EQ(at_flipped.edges[at_flipped.find(0, 2)].crease, Crease::sharp);
  EXPECT_FALSE(at_flipped.edges[at_flipped.find(0, 2)].manifold);
}

// The values for an octahedron are exact: with the normals of its corners along the axes the
// handles are (1, 1/3, 0) and so on, the middle of an edge is (5/8, 5/8, 0), that of a face (4/9,
// 4/9, 4/9).
TEST(PnTriangles, RoundAnOctahedron) {
  const test::Mesh mesh{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  const TriangleMesh welded = make_mesh(mesh.vertices, mesh.triangles, {1, nullptr});
  const Creases creases = find_creases(welded, 2, {}, false, {1, nullptr});
  const CurvedSurface curved(welded, creases, true, {1, nullptr});
  const double third = 1.0 / 3;
  EXPECT_LT(distance(curved.point(0, {0.5, 0.5, 0}), {0.625, 0.625, 0}), 1e-15);
  EXPECT_LT(distance(curved.point(0, {third, third, third}), {4.0 / 9, 4.0 / 9, 4.0 / 9}), 1e-15);
  EXPECT_LT(distance(curved.normal(0, {1, 0, 0}), {1, 0, 0}), 1e-15);
  EXPECT_LT(distance(curved.normal(0, {third, third, third}), normalized({1, 1, 1})), 1e-15);
}

// Places in a piece are spread evenly: as many in each of its sixteenths, to within a few.
TEST(Pieces, PlacesAreSpreadEvenly) {
  const Sampled sampled({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  const auto whole = cut_into_pieces(sampled.surface, 0, {}, {1, nullptr}).front();
  std::map<std::array<int, 3>, int> counts;
  for (int64_t k = 0; k < 1600; ++k) {
    const Barycentric at = place_in(whole, whole.corners(), k, {0.2, 0.6}).barycentric();
    ++counts[{static_cast<int>(4 * at.a), static_cast<int>(4 * at.b), static_cast<int>(4 * at.c)}];
  }
  EXPECT_EQ(counts.size(), 16u);
  for (const auto& [place, count] : counts) EXPECT_NEAR(count, 100, 10);
}

TEST(Sampling, MeetsTheCountAndTheSizing) {
  const auto torus = test::torus(40, 20);
  SamplingOptions options;
  for (const int64_t count : {600, 3000}) {
    options.count = count;
    const auto samples = sample_surface(torus.vertices, torus.triangles, options, 2);
    EXPECT_NEAR(static_cast<double>(samples.points.size()), static_cast<double>(count),
                0.01 * static_cast<double>(count));
  }
  options.count.reset();
  const std::vector<Vec3> sites{{1.4, 0, 0}, {-1.4, 0, 0}};
  const std::vector<double> spacings{0.05, 0.15};
  options.sites = sites;
  options.site_spacings = spacings;
  const auto graded = sample_surface(torus.vertices, torus.triangles, options, 2);
  double low = HUGE_VAL, high = 0;
  for (const double r : graded.radius) low = std::min(low, r), high = std::max(high, r);
  EXPECT_NEAR(high / low, 3, 1e-9);
  const auto most = static_cast<int64_t>(graded.points.size()) / 2;
  options.count = most;
  const auto fewer = sample_surface(torus.vertices, torus.triangles, options, 2);
  EXPECT_LE(static_cast<int64_t>(fewer.points.size()), most);
  EXPECT_GT(static_cast<int64_t>(fewer.points.size()), most * 8 / 10);
}

}  // namespace
}  // namespace medial
