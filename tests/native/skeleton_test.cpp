// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy of the inner axis, and what its collapse is built from.
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <set>
#include <thread>

#include "base/thread.h"
#include "base/union_find.h"
#include "shapes.h"
#include "skeleton/bucket_queue.h"
#include "skeleton/level.h"

namespace medial {
namespace {

Hierarchy hierarchy_of(const test::Mesh& mesh, int threads) {
  return MedialAnalysis({mesh.vertices, mesh.triangles}, {.threads = threads}, nullptr)
      .hierarchy({});
}

TEST(Hierarchy, OfATorusHasOneTunnelAtEveryLevel) {
  const Hierarchy h = hierarchy_of(test::torus(60, 30), 2);
  const Betti torus{1, 1, 0};
  EXPECT_EQ(h.betti(), torus);
  for (const double sheet : {0.0, 0.01, 0.1, 1.0}) {
    for (const double limb : {0.0, 0.04, 1.0}) {
      EXPECT_EQ(h.extract({.sheet = sheet, .limb = limb}).betti, torus) << sheet << ' ' << limb;
    }
  }
  const Level circle = h.extract({.sheet = 1, .limb = 1});
  EXPECT_TRUE(circle.generators.empty());
  EXPECT_EQ(circle.wires.size(), circle.vertices.size());
}

TEST(Hierarchy, OfABlockIsDownToOnePoint) {
  const auto points = test::ellipsoid(5000, 3);
  const Hierarchy h = MedialAnalysis({points}, {.threads = 2}, nullptr).hierarchy({});
  EXPECT_EQ(h.betti(), (Betti{1, 0, 0}));
  const Level level = h.extract({.sheet = 1, .limb = 1});
  EXPECT_EQ(level.vertices.size(), 1u);
  EXPECT_EQ(level.points.size(), 1u);
  EXPECT_NEAR(level.radius[0], 0.4, 0.05);
}

TEST(Hierarchy, IsTheSameForEveryThreadCount) {
  const test::Mesh mesh = test::torus(120, 60);
  const Hierarchy one = hierarchy_of(mesh, 1), four = hierarchy_of(mesh, 4);
  EXPECT_EQ(one.parts().partner, four.parts().partner);
  EXPECT_EQ(one.parts().limb, four.parts().limb);
  EXPECT_EQ(one.parts().outside, four.parts().outside);
  for (const auto value : {&Thickness::sheet, &Thickness::spacings, &Thickness::erosion}) {
    const auto of = [value](const Array<Thickness>& values) {
      std::vector<float> result;
      for (const Thickness& t : values) result.push_back(t.*value);
      return result;
    };
    EXPECT_EQ(of(one.parts().values.facet), of(four.parts().values.facet));
    EXPECT_EQ(of(one.parts().values.vertex), of(four.parts().values.vertex));
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
      analysis.hierarchy({}, Side::inner, &progress);
    } catch (const Cancelled&) {
      ++met;
    }
    ended = true;
  }
  EXPECT_GT(met, 0);
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

}  // namespace
}  // namespace medial
