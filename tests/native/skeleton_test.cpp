// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy of the inner axis, and what its collapse is built from.
#include <gtest/gtest.h>
#include <medial/analysis.h>
#include <medial/sampling.h>

#include <set>
#include <thread>

#include "analysis_parts.h"
#include "base/thread.h"
#include "base/union_find.h"
#include "collapse/bubbles.h"
#include "collapse/bucket_queue.h"
#include "collapse/fringe.h"
#include "collapse/sheets.h"
#include "collapse/wires.h"
#include "levels/curves.h"
#include "levels/level.h"
#include "shapes.h"

namespace medial {
namespace {

Hierarchy hierarchy_of(const test::Mesh& mesh, int threads) {
  return MedialAnalysis({mesh.vertices, mesh.triangles}, {.threads = threads}, nullptr)
      .hierarchy({});
}

// The samples of a flat block on a lattice are cospherical in eights, so many cells shrink.
TEST(Hierarchy, EdgesOfAShrunkComplexGoFromTheLowerVertexToTheHigher) {
  const int size = 12, height = 3;
  std::vector<Vec3> points;
  for (int x = 0; x <= size; ++x) {
    for (int y = 0; y <= size; ++y) {
      for (int z = 0; z <= height; ++z) {
        const bool inside = x > 0 && x < size && y > 0 && y < size && z > 0 && z < height;
        if (!inside) points.push_back(Vec3{1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  const Hierarchy h = MedialAnalysis({points}, {.threads = 2}, nullptr).hierarchy({});
  const InnerComplex& complex = h.parts().complex;
  ASSERT_GT(complex.shrunk.size(), 50u);
  for (const auto& [low, high] : complex.ends) EXPECT_LE(low, high);
  for (int32_t f = 0; f < complex.facets(); ++f) {
    const auto ring = complex.ring(f);
    for (size_t i = 0; i < ring.size(); ++i) {
      const auto [low, high] =
          std::minmax(ring[i].vertex, ring[i + 1 < ring.size() ? i + 1 : 0].vertex);
      EXPECT_EQ(complex.ends[ring[i].edge], (Edge{low, high})) << f;
    }
  }
}

TEST(Hierarchy, CancelsFromAnotherThreadInEveryStage) {
  const auto points = test::ellipsoid(20000, 5);
  const MedialAnalysis analysis({points}, {.threads = 2}, nullptr);
  int met = 0;
  for (const double share : {0.0, 0.1, 0.3, 0.45, 0.55, 0.72}) {
    Progress progress;
    std::atomic<bool> ended{false};
    const Thread watcher([&] {
      while (progress.fraction() < share && !ended) std::this_thread::yield();
      progress.cancel();
    });
    try {
      analysis.hierarchy({}, Side::inner, std::nullopt, &progress);
    } catch (const Cancelled&) {
      ++met;
    }
    ended = true;
  }
  EXPECT_GT(met, 0);
}

constexpr double kHalf = 1, kRadius = 0.4;  // of a capsule: half its axis, along z, and its tube

Vec3 from_axis_of_capsule(const Vec3& p) { return p - Vec3{0, 0, std::clamp(p.z, -kHalf, kHalf)}; }

// Blue noise.
std::vector<Vec3> samples_of_capsule(int count) {
  constexpr int kRows = 64, kRound = 96;
  test::Mesh mesh;
  for (int i = 0; i <= kRows; ++i) {
    for (int j = 0; j < kRound; ++j) {
      const double u = std::numbers::pi * i / kRows, v = 2 * std::numbers::pi * j / kRound;
      const Vec3 p{std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), -std::cos(u)};
      mesh.vertices.push_back(kRadius * p + Vec3{0, 0, 2 * i < kRows ? -kHalf : kHalf});
      if (i == kRows) continue;
      const int next = (j + 1) % kRound, a = i * kRound;
      mesh.triangles.push_back({a + j, a + next, a + kRound + next});
      mesh.triangles.push_back({a + j, a + kRound + next, a + kRound + j});
    }
  }
  auto points = sample_surface(mesh.vertices, mesh.triangles, {.count = count}, 2).points;
  for (Vec3& p : points) {
    const Vec3 away = from_axis_of_capsule(p);
    p = p - away + kRadius * normalized(away);
  }
  return points;
}

// Without the anchors of the fire the zigzag of the Voronoi edges makes the slope 1.07 to 1.13.
TEST(Wires, ElongationInACapsuleIsTheWayFromTheEndOfItsAxisOnEachEdge) {
  const auto points = samples_of_capsule(8000);
  std::vector<Vec3> normals;
  for (const Vec3& p : points) normals.push_back(from_axis_of_capsule(p));
  const MedialAnalysis analysis({.points = points, .normals = normals}, {.threads = 2}, nullptr);
  const auto& made = analysis.parts();
  const medial::Run run = made.run();
  const InnerComplex complex =
      inner_complex(made.samples, made.triangulation, made.voronoi, made.edges, made.sides, run);
  const Facets facets{made.samples.points, made.triangulation, made.voronoi,
                      made.edges,          made.significance,  made.sides};
  const EdgeWeights weight(facets, {});
  Collapse collapse = whole(complex, weight, run);
  open_bubbles(complex, weight, collapse, run);
  peel_facets(complex, weight, collapse, run);
  peel_wires(complex, collapse, run);
  const Burning burning = burn(complex, radius_by(complex, made.samples.points), collapse, run);
  const Wires wires = burn_wires(complex, burning, collapse, run);
  const Hierarchy hierarchy = analysis.hierarchy({});  // knows which edges are no short spurs
  // A line through elongations over ways, by least squares.
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const int32_t v : wires.order) {
    const int32_t edge = collapse.edge_of_vertex[v];
    if (hierarchy.parts().limb_of_edge(edge) < 0.04) continue;
    const auto& [a, b] = complex.ends[edge];
    const Vec3 middle = 0.5 * (complex.position[a] + complex.position[b]);
    const double way = kHalf - std::abs(middle.z);
    const double elongation = wires.elongation[v];
    if (way < 0.1) continue;
    ++count, x += way, y += elongation, xx += way * way, xy += way * elongation;
  }
  EXPECT_GT(count, 1000);
  EXPECT_NEAR((count * xy - x * y) / (count * xx - x * x), 1, 1e-3);
}

// Returns the values of facets that are a sheet each.
Array<float> values_of_sheets(std::vector<AtJunction> junctions, std::vector<float> thickness) {
  Sheets sheets;
  for (size_t f = 0; f < thickness.size(); ++f) sheets.of_facet.push_back(static_cast<int32_t>(f));
  sheets.junctions.assign(junctions.begin(), junctions.end());
  InnerComplex complex;
  complex.generators.resize(thickness.size());
  complex.offsets.assign(thickness.size() + 1, 0);
  Collapse collapse;
  collapse.partner.assign(2, kAlone);
  return drop_values(complex, collapse, sheets, thickness, {1, nullptr, nullptr});
}

// A fork of a sheet, 0, has two prongs, of which the thicker one, 2, goes on in it.
TEST(Sheets, GoOnInTheThickerProngOfAFork) {
  const auto values = values_of_sheets({{0, 0}, {0, 1}, {0, 2}}, {10, 0.1F, 0.2F});
  EXPECT_EQ(std::vector<float>(values.begin(), values.end()), (std::vector<float>{10, 0.1F, 10}));
}

// The same, but the thicker prong ends on the sheet at another junction.
TEST(Sheets, DoNotGoOnInWhatBranchesFromThemElsewhere) {
  const auto values =
      values_of_sheets({{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 0}, {1, 2}}, {10, 0.1F, 0.2F});
  EXPECT_EQ(std::vector<float>(values.begin(), values.end()), (std::vector<float>{10, 0.1F, 0.2F}));
}

TEST(BucketQueue, GivesIdsInOrderOfTheirKeysHoweverTheyCome) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1.5);
  BucketQueue queue(0.01, 100);
  std::set<std::pair<double, int32_t>> expected;
  int32_t next = 0;
  const auto push = [&] {
    const double key = next % 5 == 0 ? 0.25 : uniform(random);
    expected.emplace(key, next);
    queue.push(key, next++);
  };
  for (int i = 0; i < 300; ++i) push();
  for (int i = 0; i < 2000; ++i) {
    if (i % 3 == 0) push();
    const int32_t id = queue.pop();
    if (expected.empty()) {
      EXPECT_EQ(id, -1);
      continue;
    }
    EXPECT_EQ(id, expected.begin()->second);
    expected.erase(expected.begin());
  }
}

TEST(BucketQueue, KnowsWhatComesSoonWhateverTheSizeOfTheKeys) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> exponent(-12, 12);
  BucketQueue queue(1e-3, 16);
  constexpr int32_t kCount = 500;
  std::set<std::pair<double, int32_t>> expected;
  for (int32_t id = 0; id < kCount; ++id) {
    const double key = id % 50 == 0 ? HUGE_VAL : id % 50 == 1 ? 0 : std::pow(10, exponent(random));
    expected.emplace(key, id);
    queue.push(key, id);
  }
  std::vector<int32_t> order;
  for (const auto& [key, id] : expected) order.push_back(id);
  for (size_t i = 0; i < order.size(); ++i) {
    ASSERT_EQ(queue.pop(), order[i]);
    for (size_t ahead = 0; ahead < BucketQueue::kAhead; ++ahead) {
      const size_t later = i + 1 + ahead;
      ASSERT_EQ(queue.soon(ahead), later < order.size() ? order[later] : -1);
    }
  }
  EXPECT_EQ(queue.pop(), -1);
}

TEST(Incident, KnowsTheLastOneAndTheOtherOfTwo) {
  constexpr int32_t kLarge = INT32_MAX - 1;
  Incident at;
  for (int32_t id = 0; id < 1000; ++id) at.add(kLarge - id);
  for (int32_t id = 2; id < 1000; ++id) at.remove_shared(kLarge - id);
  EXPECT_EQ(at.count(), 2);
  EXPECT_EQ(at.other_than(kLarge), kLarge - 1);
  at.remove(kLarge - 1);
  EXPECT_EQ(at.last(), kLarge);
}

TEST(SharedUnionFind, FindsTheSetsOfASerialOneByManyThreads) {
  constexpr int32_t kCount = 20000;
  std::mt19937 random(3);
  std::uniform_int_distribution<int32_t> any(0, kCount - 1);
  std::vector<Edge> pairs(kCount * 2 / 3);
  for (Edge& e : pairs) e = {any(random), any(random)};
  UnionFind serial(kCount);
  for (const auto& [a, b] : pairs) serial.unite(a, b);
  SharedUnionFind shared(kCount, {4});
  parallel_for(
      static_cast<int64_t>(pairs.size()), {4},
      [&](int64_t i) { shared.unite(pairs[i][0], pairs[i][1]); }, 16);
  EXPECT_EQ(std::move(shared).representatives({4}), std::move(serial).representatives());
}

// --- a level for the eye

TEST(PointTree, FindsWhatALookAtAllFinds) {
  for (const int count : {1, 7, 8, 9, 500}) {
    const auto some = test::ellipsoid(count, 7);
    const PointTree tree(some);
    for (const Vec3& query : test::ellipsoid(40, 8)) {
      std::vector<double> far;
      for (const Vec3& p : some) far.push_back(distance(p, query));
      const auto least = std::min_element(far.begin(), far.end());
      EXPECT_EQ(tree.nearest(query).id, least - far.begin());
      EXPECT_DOUBLE_EQ(tree.nearest(query).distance, *least);
      EXPECT_TRUE(tree.has_within(query, 1.001 * *least));
      EXPECT_FALSE(tree.has_within(query, 0.999 * *least));
      std::sort(far.begin(), far.end());
      EXPECT_DOUBLE_EQ(tree.reach(query, 5), far[std::min(4, count - 1)]);
    }
    std::vector<Vec3> met;
    tree.visit([](const Box& box) { return box.low.x < 0.1; },
               [&](const Vec3& point) { met.push_back(point); });
    auto next = met.begin();  // they come in the order of the list
    for (const Vec3& point : some) {
      const bool is_next = next != met.end() && *next == point;
      EXPECT_TRUE(is_next || !(point.x < 0.1));
      next += is_next;
    }
    EXPECT_EQ(next, met.end());
  }
}

TEST(PointTree, OfEquallyNearPointsTheLowestIsTheNearest) {
  const std::vector<Vec3> corners{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  EXPECT_EQ(PointTree(corners).nearest({0, 0, 0}).id, 0);
}

TEST(Chains, EndWhereWiresBranchOrAreFixed) {
  // A cross at 2, a fixed vertex 5 inside an arm, and a closed curve 7-8-9.
  const std::vector<Edge> wires{{0, 1}, {1, 2}, {2, 3}, {2, 4}, {4, 5},
                                {5, 6}, {7, 8}, {8, 9}, {9, 7}};
  std::vector<uint8_t> fixed(10, 0);
  fixed[5] = 1;
  const auto chains = chains_of(wires, fixed);
  std::vector<std::vector<int32_t>> vertices;
  for (const Chain& chain : chains) vertices.push_back(chain.vertices);
  EXPECT_EQ(vertices, (std::vector<std::vector<int32_t>>{
                          {0, 1, 2}, {2, 3}, {2, 4, 5}, {5, 6}, {7, 8, 9, 7}}));
  EXPECT_EQ(chains[0].loose, (std::array<bool, 2>{true, false}));
  EXPECT_EQ(chains[2].loose, (std::array<bool, 2>{false, false}));
  EXPECT_EQ(chains[3].loose, (std::array<bool, 2>{false, true}));
  EXPECT_TRUE(chains[4].closed);
  EXPECT_FALSE(chains[3].closed);
}

TEST(Canal, IsFoundFromBesideItsAxisAndNotBetweenTwoWalls) {
  std::vector<Vec3> tube, walls;
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < 40; ++k) {
      const double z = 0.05 * (i - 20), angle = 2 * 3.14159265358979 * (k + 0.5 * (i % 2)) / 40;
      tube.push_back({std::cos(angle), std::sin(angle), z});
      walls.push_back({0.05 * (k - 20), i % 2 ? 1.0 : -1.0, z});
    }
  }
  Canal canal{.centre = {0.03, -0.02, 0}, .radius = 0.98, .tangent = {0, 0, 1}};
  Canal between = canal;
  for (int fit = 0; fit < 3; ++fit) {
    canal = fit_canal(PointTree(tube), canal, 0.5);
    between = fit_canal(PointTree(walls), between, 0.5);
  }
  EXPECT_LT(length(canal.centre), 1e-6);
  EXPECT_NEAR(canal.radius, 1, 1e-6);
  EXPECT_EQ(canal.trust, 1);
  EXPECT_EQ(between.trust, 0);
  EXPECT_EQ(between.centre, (Vec3{0.03, -0.02, 0}));
}

TEST(Canal, IsBentAndGrowsLikeItsBalls) {
  // Balls of the radius 1 + 0.3 t round (0.2 t^2, 0, t) touch the canal all round, where the way to
  // the centre takes -(1 + 0.3 t) 0.3 of the axis' derivative.
  std::vector<Vec3> samples;
  for (int i = -60; i <= 60; ++i) {
    const double t = 0.025 * i, radius = 1 + 0.3 * t;
    const Vec3 way{0.4 * t, 0, 1};
    const double back = radius * 0.3, size = length(way);
    const Vec3 aside = (1 / size) * Vec3{1, 0, -0.4 * t};
    const double across = std::sqrt(radius * radius - back * back / (size * size));
    for (int k = 0; k < 60; ++k) {
      const double angle = 2 * 3.14159265358979 * (k + 0.5 * (i & 1)) / 60;
      samples.push_back(Vec3{0.2 * t * t, 0, t} - (back / (size * size)) * way +
                        across * (std::cos(angle) * aside + std::sin(angle) * Vec3{0, 1, 0}));
    }
  }
  Canal canal{.centre = {0.03, -0.02, 0}, .radius = 0.97, .slope = 0.25, .tangent = {0, 0, 1}};
  canal.bend = {0.2 * 0.5 * 0.5, 0, 0};
  for (int fit = 0; fit < 6; ++fit) canal = fit_canal(PointTree(samples), canal, 0.5);
  EXPECT_LT(length(canal.centre), 1e-4);
  EXPECT_NEAR(canal.radius, 1, 1e-4);
  EXPECT_NEAR(canal.slope, 0.3, 1e-3);
  EXPECT_NEAR(canal.flare, 0, 2e-3);
  EXPECT_GT(canal.trust, 0.9);
}

TEST(Canal, AsSteepAsAllThatIsNotFitted) {
  std::vector<Vec3> cone;
  for (int i = 0; i < 80; ++i) {
    for (int k = 0; k < 40; ++k) {
      const double away = 0.05 * i, angle = 2 * 3.14159265358979 * (k + 0.5 * (i % 2)) / 40;
      cone.push_back({away * std::cos(angle), away * std::sin(angle), 0.3 * away});
    }
  }
  const Canal from{.centre = {0, 0, 1}, .radius = 0.958, .slope = 0.89, .tangent = {0, 0, 1}};
  EXPECT_EQ(fit_canal(PointTree(cone), from, 0.2).trust, 0);
}

TEST(Hierarchy, ARelaxedTorusIsOneClosedCurve) {
  const Level circle =
      hierarchy_of(test::torus(60, 30), 2).extract({.sheet = 1, .limb = 1, .relaxed = true});
  std::vector<int> wires_at(circle.vertices.size(), 0);
  for (const Edge& wire : circle.wires) {
    for (const int32_t v : wire) ++wires_at[v];
  }
  EXPECT_GT(wires_at.size(), 50u);
  for (const int count : wires_at) EXPECT_EQ(count, 2);
}

TEST(Hierarchy, BallsOfRelaxedSheetsEndAtTheSamples) {
  const auto points = test::ellipsoid(1500, 3);
  const Level level = MedialAnalysis({points}, {.threads = 2}, nullptr)
                          .hierarchy({})
                          .even({.limb = 1})
                          .extract({.limb = 1, .relaxed = true});
  ASSERT_FALSE(level.vertices.empty());
  int moved = 0;
  for (size_t v = 0; v < level.vertices.size(); ++v) {
    double nearest = HUGE_VAL;
    for (const Vec3& p : points) nearest = std::min(nearest, distance(p, level.vertices[v]));
    EXPECT_NEAR(level.radius[v], nearest, 1e-9);
    moved += level.vertices[v] != level.exact[v];
  }
  EXPECT_GT(moved, 50);
}

}  // namespace
}  // namespace medial
