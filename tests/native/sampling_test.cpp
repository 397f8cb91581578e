// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <medial/sampling.h>

#include "sampling/poisson_disk.h"
#include "shapes.h"

namespace medial {
namespace {

Creases creases_of(const test::Mesh& mesh, TriangleMesh& welded, double angle = 0.5) {
  welded = make_mesh(mesh.vertices, mesh.triangles, {2, nullptr});
  return find_creases(welded, angle, {}, false, {2, nullptr});
}

TEST(Creases, AFoldIsOneSharpChainAndFourBoundaryChains) {
  TriangleMesh mesh;
  const Creases creases = creases_of(test::folded(), mesh);
  EXPECT_EQ(creases.edges[creases.find(1, 0)].crease, Crease::sharp);
  EXPECT_EQ(creases.edges[creases.find(0, 3)].crease, Crease::none);
  EXPECT_EQ(creases.find(2, 5), -1);
  EXPECT_EQ(creases.chains.size(), 7);  // every vertex is a corner: right angles
  EXPECT_EQ(std::count(creases.corner.begin(), creases.corner.end(), 1), 6);
}

TEST(Creases, EveryCreaseIsInOneChainWhateverTheTurn) {
  const auto torus = test::torus(12, 6);
  for (const double angle : {0.0, 0.3, 0.6, 1.0}) {
    TriangleMesh mesh;
    const Creases creases = creases_of(torus, mesh, angle);
    std::map<int32_t, int> uses;
    for (const ChainLink& link : creases.chains.items) ++uses[link.edge];
    for (size_t e = 0; e < creases.edges.size(); ++e) {
      EXPECT_EQ(uses[static_cast<int32_t>(e)], creases.edges[e].crease != Crease::none);
    }
  }
}

TEST(PnTriangles, KeepTheirCornersAndAgreeAlongEveryEdge) {
  const auto torus = test::torus(16, 8);
  TriangleMesh mesh;
  const Creases creases = creases_of(torus, mesh, 0.7);  // some sharp, some smooth
  const CurvedSurface surface(mesh, creases, true, {2, nullptr});
  int sharp = 0;
  for (const MeshEdge& edge : creases.edges) {
    sharp += edge.crease == Crease::sharp;
    for (int i = 0; i <= 8; ++i) {
      std::array<Vec3, 2> reached;
      for (const int side : {0, 1}) {
        const int32_t t = edge.triangles[side];
        std::array<double, 3> at{};
        for (int k = 0; k < 3; ++k) {
          if (mesh.triangles[t][k] == edge.ends[0]) at[k] = 1 - i / 8.0;
          if (mesh.triangles[t][k] == edge.ends[1]) at[k] = i / 8.0;
        }
        reached[side] = surface.point(t, {at[0], at[1], at[2]});
      }
      EXPECT_LT(distance(reached[0], reached[1]), 1e-14);
      if (i == 0) {
        EXPECT_EQ(reached[0], mesh.points[edge.ends[0]]);
      }
    }
  }
  EXPECT_GT(sharp, 0);
  EXPECT_LT(sharp, static_cast<int>(creases.edges.size()));
}

TEST(Pieces, CoverTheirTriangles) {
  TriangleMesh mesh;
  const Creases creases = creases_of(test::folded(), mesh);
  const CurvedSurface surface(mesh, creases, false, {1, nullptr});
  for (const int cuts : {0, 1, 3}) {
    double area = 0;
    const auto pieces = cut_into_pieces(surface, cuts, {}, {1, nullptr});
    EXPECT_EQ(pieces.size(), 4u << 2 * cuts);
    for (const Piece& piece : pieces) {
      area += piece.area;
      double share = 0;  // determinant of the corners' coordinates
      const auto [p, q, r] = piece.corners();
      share += p.a * (q.b * r.c - q.c * r.b) - p.b * (q.a * r.c - q.c * r.a);
      share += p.c * (q.a * r.b - q.b * r.a);
      EXPECT_NEAR(std::abs(share), std::pow(0.25, cuts), 1e-12);
      const Barycentric at = place_in(piece, piece.corners(), 7, {0.3, 0.9}).barycentric();
      EXPECT_GE(std::min({at.a, at.b, at.c}), 0);
    }
    EXPECT_NEAR(area, 8, 1e-12);
  }
}

TEST(PointTree, TakesTheLowestIdsOfEquallyNearSites) {
  std::vector<Vec3> sites;
  for (int i = 0; i < 1000; ++i) {
    sites.push_back({i % 10 * 0.1, i / 10 % 10 * 0.1, i / 100 * 0.1});
  }
  const PointTree tree = PointTree::sorted(sites, {2});
  std::vector<Neighbour> found;
  for (const Vec3& query : sites) {
    std::vector<std::pair<double, int32_t>> all;
    for (const Vec3& site : sites) {
      all.push_back({squared_length(site - query), static_cast<int32_t>(all.size())});
    }
    std::sort(all.begin(), all.end());
    for (const size_t count : {1, 5, 20}) {
      tree.find(query, count, found);
      ASSERT_EQ(found.size(), count);
      for (size_t i = 0; i < count; ++i) ASSERT_EQ(found[i].id, all[i].second);
    }
  }
  tree.find({}, 1100, found);
  EXPECT_EQ(found.size(), 1000u);
  EXPECT_EQ(PointTree::sorted({}, {}).nearest({}), (Neighbour{HUGE_VAL, -1}));
}

TEST(SizingField, GrowsNoFasterThanItsGrading) {
  std::vector<Vec3> sites;
  std::vector<double> spacings;
  for (int i = 0; i <= 100; ++i) {
    sites.push_back({0.1 * i, 0, 0});
    spacings.push_back(i == 50 ? 0.01 : 1);
  }
  const SizingField field(sites, spacings, {2, nullptr});
  for (int i = 0; i <= 100; ++i) {
    EXPECT_NEAR(field(sites[i]), std::min(1.0, 0.01 + 0.3 * 0.1 * std::abs(i - 50)), 1e-12);
  }
}

// All nearest neighbours of the fine sites are fine, on their own wall.
TEST(SizingField, ReachesSparseSitesOfAnOppositeWall) {
  std::vector<Vec3> sites;
  std::vector<double> spacings;
  for (int i = 0; i < 100; ++i) {
    sites.push_back({0.02 * (i % 10), 0.02 * (i / 10), 1});
    spacings.push_back(0.02);
  }
  sites.push_back({0.1, 0.1, 0});
  spacings.push_back(3);
  const medial::Run run{2, nullptr};
  EXPECT_EQ(SizingField(sites, spacings, run)(sites.back()), 3);
  EXPECT_NEAR(SizingField(sites, spacings, run, true)(sites.back()), 0.02 + 0.3, 1e-3);
}

TEST(PoissonDisks, KeepTheirDistanceFromEachOtherAndFromFixedOnes) {
  TriangleMesh mesh;
  const Creases creases = creases_of(test::folded(), mesh);
  const CurvedSurface surface(mesh, creases, false, {2, nullptr});
  const auto pieces = cut_into_pieces(surface, 0, {0.1}, {2, nullptr});
  const std::vector<Disk> fixed{{{0, 1, 0}, 0.5, {}}, {{1, 1, 0}, 0.1, {0, 0, -1}}};
  const auto placed = poisson_disks(surface, pieces, 1, fixed, 14, 1, {2, nullptr});
  EXPECT_GT(placed.size(), 400u);
  bool inside = false;
  for (size_t i = 0; i < placed.size(); ++i) {
    const Disk& a = placed[i].disk;
    EXPECT_GE(distance(a.centre, fixed[0].centre), 0.1);
    inside |= distance(a.centre, fixed[1].centre) < 0.1;  // it looks the other way
    for (size_t j = 0; j < i; ++j) {
      const Disk& b = placed[j].disk;
      if (dot(a.normal, b.normal) > 0) {
        EXPECT_GE(distance(a.centre, b.centre), 0.1);
      }
    }
  }
  EXPECT_TRUE(inside);
}

}  // namespace
}  // namespace medial
