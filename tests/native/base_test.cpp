// SPDX-License-Identifier: GPL-3.0-or-later
// The vocabulary of the stages against what it says in plain loops.
#include <gtest/gtest.h>

#include <random>

#include "base/double_double.h"
#include "base/oriented_box.h"
#include "base/parallel.h"
#include "base/point_tree.h"
#include "base/polygon_edges.h"
#include "base/rows.h"
#include "base/sort.h"
#include "base/union_find.h"
#include "delaunay/samples.h"
#include "shapes.h"

namespace medial {
namespace {

std::vector<int32_t> random_ids(size_t count, int32_t below, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<int32_t> ids(count);
  for (int32_t& id : ids) id = static_cast<int32_t>(random() % static_cast<uint32_t>(below));
  return ids;
}

TEST(ParallelFor, StopsWhereTheBarDoesNotMove) {
  Progress progress;
  int done = 0;
  const auto body = [&](int64_t i) {
    ++done;
    if (i == 10) progress.cancel();
  };
  const medial::Run run{1, &progress, nullptr, false};
  EXPECT_THROW(parallel_for(100, run, body, 1), Cancelled);
  EXPECT_EQ(done, 11);
  EXPECT_EQ(progress.fraction(), 0);
}

TEST(RowsContaining, ListsTheRowsOfEveryId) {
  for (const int threads : {1, 3}) {
    const auto ids = random_ids(3000, 61, 1);
    std::vector<Triangle> table;
    for (size_t i = 0; i < ids.size(); i += 3) table.push_back({ids[i], ids[i + 1], ids[i + 2]});
    const auto lists = rows_containing(std::span<const Triangle>(table), 60, {threads, nullptr});
    ASSERT_EQ(lists.size(), 60);
    for (int32_t k = 0; k < 60; ++k) {
      std::vector<int32_t> expected;
      for (size_t i = 0; i < table.size(); ++i) {
        for (const int32_t id : table[i]) {
          if (id == k) expected.push_back(static_cast<int32_t>(i));
        }
      }
      EXPECT_EQ(std::vector<int32_t>(lists[k].begin(), lists[k].end()), expected) << k;
    }
  }
}

TEST(BucketOrder, IsByBucketThenKeyThenId) {
  const auto bucket = random_ids(5000, 40, 2), key = random_ids(5000, 5, 3);
  const auto order = bucket_order(
      5000, 40, {3, nullptr}, [&](int64_t i) { return bucket[i]; },
      [&](int64_t i) { return key[i]; });
  std::vector<int32_t> expected(5000);
  std::iota(expected.begin(), expected.end(), 0);
  std::sort(expected.begin(), expected.end(), [&](int32_t a, int32_t b) {
    return std::tuple(bucket[a], key[a], a) < std::tuple(bucket[b], key[b], b);
  });
  EXPECT_EQ(std::vector<int32_t>(order.begin(), order.end()), expected);
}

TEST(UnionFind, TheLowestIdStandsForItsSet) {
  const auto ids = random_ids(160, 100, 4);
  UnionFind sets(100);
  std::vector<int32_t> lowest(100);
  std::iota(lowest.begin(), lowest.end(), 0);
  for (size_t i = 0; i < ids.size(); i += 2) {
    sets.unite(ids[i], ids[i + 1]);
    const int32_t a = lowest[ids[i]], b = lowest[ids[i + 1]];
    for (int32_t& x : lowest) {
      if (x == std::max(a, b)) x = std::min(a, b);
    }
    for (int32_t id = 0; id < 100; ++id) ASSERT_EQ(sets.find(id), lowest[id]);
  }
  const auto found = std::move(sets).representatives();
  EXPECT_EQ(std::vector<int32_t>(found.begin(), found.end()), lowest);
}

TEST(OrientedUnionFind, KnowsWhatIsTurned) {
  std::mt19937 random(5);
  OrientedUnionFind sets(200);
  std::vector<uint8_t> turned(200);  // of every thing, to be found again up to whole sets
  for (auto& t : turned) t = random() % 2;
  const auto ids = random_ids(500, 200, 6);
  for (size_t i = 0; i < ids.size(); i += 2) {
    sets.unite(ids[i], ids[i + 1], turned[ids[i]] != turned[ids[i + 1]]);
  }
  int others = 0;
  for (int32_t id = 0; id < 200; ++id) {
    const auto [root, is_turned] = sets.find(id);
    EXPECT_LE(root, id);
    EXPECT_EQ(is_turned, turned[id] != turned[root]);
    others += root != id;
  }
  EXPECT_GT(others, 150);
}

// On a lattice the Hilbert curve goes from neighbour to neighbour.
TEST(HilbertOrder, StepsFromNeighbourToNeighbour) {
  std::vector<Vec3> lattice;
  for (int i = 0; i < 512; ++i)
    lattice.push_back({1.0 * (i & 7), 1.0 * (i >> 3 & 7), 1.0 * (i >> 6)});
  const auto order = hilbert_order(lattice, {2, nullptr});
  for (size_t i = 1; i < order.size(); ++i) {
    EXPECT_EQ(distance(lattice[order[i]], lattice[order[i - 1]]), 1) << i;
  }
}

TEST(DistinctRows, KeepTheFirstOfEqualRows) {
  auto rows = test::random_points(300, 9);
  for (int i = 0; i < 100; ++i) rows.push_back(rows[3 * i]);
  const DistinctRows distinct = distinct_rows(rows, "point", {2, nullptr});
  ASSERT_EQ(distinct.count(), 300);
  for (size_t i = 0; i < rows.size(); ++i) {
    const int32_t p = distinct.point_of_row[i];
    EXPECT_EQ(distinct.points[p], rows[i]);
    EXPECT_EQ(distinct.row[p],
              i < 300 ? static_cast<int32_t>(i) : 3 * (static_cast<int32_t>(i) - 300));
  }
}

TEST(PolygonEdges, AreThoseOfTheCorners) {
  const auto mesh = test::torus(9, 7);
  std::vector<int32_t> offsets{0}, corners;
  for (const Triangle& t : mesh.triangles) {
    corners.insert(corners.end(), t.begin(), t.end());
    offsets.push_back(static_cast<int32_t>(corners.size()));
  }
  const auto vertices = static_cast<int32_t>(mesh.vertices.size());
  const PolygonEdges edges = polygon_edges(offsets, corners, vertices, {2, nullptr});
  std::vector<Edge> expected;
  for (const auto& [edge, uses] : test::edge_uses(mesh.triangles)) expected.push_back(edge);
  EXPECT_EQ(edges.ends, expected);
  for (size_t c = 0; c < corners.size(); ++c) {
    const int32_t here = corners[c], next = corners[c % 3 == 2 ? c - 2 : c + 1];
    EXPECT_EQ(edges.ends[edges.of_corner[c]], (Edge{std::min(here, next), std::max(here, next)}));
  }
}

TEST(DoubleDouble, KeepsTwiceTheDigits) {
  const DoubleDouble near_one = DoubleDouble(1) + DoubleDouble(0x1p-80);
  const DoubleDouble squared = near_one * near_one - DoubleDouble(1);
  EXPECT_EQ(squared.high, 0x1p-79);
  const double third = 1.0 / 3;
  const DoubleDouble off = product(third, 3) - DoubleDouble(1);
  EXPECT_EQ(off.high, -0x1p-54);
}

// The corners of a thin plate, with normals that are rounding or lie along the longest way: the
// axes are at right angles, and the box holds its points.
TEST(OrientedBox, HoldsPointsWhateverTheNormal) {
  std::mt19937 random(7);
  const auto corner = [&](int k) {
    return Vec3{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 0.01 : -0.01};
  };
  for (int trial = 0; trial < 4000; ++trial) {
    std::vector<Vec3> points;
    for (int i = 0; i < 4; ++i) points.push_back(corner(static_cast<int>(random() % 8)));
    const Vec3 rounding{0, 0, 1e-19 * static_cast<double>(trial % 3)};
    const Vec3 normal = trial % 2 == 0 ? rounding : points[1] - points[0];
    const OrientedBox box = oriented_box(normal, points);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(dot(box.axis[i], box.axis[j]), i == j, 1e-12);
    }
    for (const Vec3& p : points) EXPECT_LT(squared_distance(box, p), 1e-24);
  }
}

// 200 points, all at twice the radius of the samples about the centre of their box, none far from
// its neighbours: 200 discs of this distance cover 0.72 to 0.91 of a sphere.
TEST(BoundingSphere, IsTwiceAsWideAsTheSamplesAndEven) {
  Samples samples = make_samples(test::ellipsoid(100, 10), {1, nullptr});
  const Vec3 centre = box_of(samples.points).centre();
  double radius = 0;
  for (const Vec3& p : samples.points) radius = std::max(radius, distance(p, centre));
  add_bounding_sphere(samples);
  ASSERT_EQ(samples.points.size(), 300u);
  EXPECT_EQ(samples.count(), 100);
  for (size_t i = 100; i < 300; ++i) {
    EXPECT_NEAR(distance(samples.points[i], centre), 2 * radius, 1e-12);
    double nearest = HUGE_VAL;
    for (size_t j = 100; j < 300; ++j) {
      if (j != i) nearest = std::min(nearest, distance(samples.points[i], samples.points[j]));
    }
    // Each point has 1/200 of the sphere; a disc of that area has the diameter 4 / sqrt(200).
    EXPECT_GT(nearest / (2 * radius), 0.75 * 4 / std::sqrt(200.0));
    EXPECT_LT(nearest / (2 * radius), 1.0 * 4 / std::sqrt(200.0));
  }
}

}  // namespace
}  // namespace medial
