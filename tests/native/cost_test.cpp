// SPDX-License-Identifier: GPL-3.0-or-later
// The cost of an analysis and of an extract, in counts that are the same on every machine.
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <array>
#include <string>

#include "counted_new.h"
#include "shapes.h"

namespace medial {
namespace {

struct Cost {
  double held;         // bytes per point, by the analysis when it is done: its peak
  double beside;       // at the peak beside its arena, the axis among it, the input not counted
  double allocations;  // per 1000 points, outside the arena
  double rings;        // walked by the extract, per facet
};

// Points on an ellipsoid or vertices of a grid on a torus, of which many are cospherical.
struct Case {
  const char* name;
  bool torus;
  SidesFrom sides;
  Side side;
  Cost most;
};

// About 10 % above what is measured, so that a loss is seen.
constexpr std::array kCases{
    Case{"Ellipsoid", false, SidesFrom::none, Side::both, {1080, 257, 330, 1.001}},
    Case{"EllipsoidByTightCocone",
         false,
         SidesFrom::tight_cocone,
         Side::inner,
         {1200, 305, 370, 1.001}},
    Case{"EllipsoidAutomatic", false, SidesFrom::automatic, Side::inner, {1200, 305, 370, 1.001}},
    Case{"TorusBySurface", true, SidesFrom::surface, Side::inner, {1380, 372, 42600, 1.001}},
};

Cost cost(const Case& c, int threads) {
  test::Mesh mesh;
  if (c.torus) {
    mesh = test::torus(120, 80);
  } else {
    mesh.vertices = test::ellipsoid(30000, 3);
  }
  const auto count = static_cast<double>(mesh.vertices.size());
  const int64_t before = test::live_bytes;
  test::peak_bytes = before;
  test::allocations = 0;
  const MedialAnalysis analysis({mesh.vertices, mesh.triangles},
                                {.sides = c.sides, .threads = threads}, nullptr);
  const auto held = static_cast<double>(analysis.bytes()) / count;
  const MedialMesh axis = analysis.extract({.side = c.side});
  EXPECT_GT(axis.generators.size(), 5000u);
  return {held, static_cast<double>(test::peak_bytes - before) / count,
          1000 * static_cast<double>(test::allocations) / count,
          static_cast<double>(axis.rings) / static_cast<double>(axis.generators.size())};
}

class CostOf : public testing::TestWithParam<Case> {};

TEST_P(CostOf, AnalysisAndExtract) {
  if (!Arena::in_use()) GTEST_SKIP() << "built without arenas, which the figures are measured with";
  const Cost& most = GetParam().most;
  const Cost one = cost(GetParam(), 1), two = cost(GetParam(), 2);
  EXPECT_LE(one.held, most.held);
  EXPECT_LE(one.beside, most.beside);
  EXPECT_LE(one.allocations, most.allocations);
  EXPECT_LE(one.rings, most.rings);
  // A second thread needs room for what it works on, and nothing per point. But with one the tree
  // of the faces is there early, beside what the triangulation takes.
  EXPECT_LE(two.held, 1.02 * one.held);
  EXPECT_LE(two.beside, (GetParam().sides == SidesFrom::surface ? 1.2 : 1.1) * one.beside);
  EXPECT_LE(two.allocations, 1.1 * one.allocations);
  EXPECT_EQ(two.rings, one.rings);
  RecordProperty("held_bytes_per_point", std::to_string(one.held));
  RecordProperty("bytes_beside_per_point", std::to_string(one.beside));
  RecordProperty("allocations_per_1000_points", std::to_string(one.allocations));
}

INSTANTIATE_TEST_SUITE_P(Bytes, CostOf, testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace medial
