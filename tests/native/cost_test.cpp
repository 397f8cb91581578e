// What an analysis and an extract cost, in counts that are the same on every machine.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "counted_new.h"
#include "medial/analysis.h"
#include "shapes.h"

namespace medial {
namespace {

struct Cost {
  double peak;         // bytes per point, the input not counted
  double kept;         // of these, by the analysis when it is done
  double allocations;  // per 1000 points
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
    Case{"Ellipsoid", false, SidesFrom::none, Side::both, {1100, 770, 4800}},
    Case{"EllipsoidByTightCocone", false, SidesFrom::tight_cocone, Side::inner, {1100, 820, 4900}},
    Case{"TorusBySurface", true, SidesFrom::surface, Side::inner, {1570, 1060, 45000}},
};

Cost cost(const Case& c, int threads) {
  test::Mesh mesh;
  if (c.torus) {
    mesh = test::torus(120, 80);
  } else {
    mesh.vertices = test::ellipsoid(30000, 3);
  }
  const double count = static_cast<double>(mesh.vertices.size());
  const int64_t before = test::live_bytes;
  test::peak_bytes = before;
  test::allocations = 0;
  const MedialAnalysis analysis({mesh.vertices, mesh.triangles},
                                {.sides = c.sides, .threads = threads}, nullptr);
  const double kept = static_cast<double>(test::live_bytes - before) / count;
  const MedialMesh axis = analysis.extract({.side = c.side});
  EXPECT_GT(axis.generators.size(), 5000u);
  return {static_cast<double>(test::peak_bytes - before) / count, kept,
          1000 * static_cast<double>(test::allocations) / count};
}

class CostOf : public testing::TestWithParam<Case> {};

TEST_P(CostOf, AnalysisAndExtract) {
  const Cost& most = GetParam().most;
  const Cost one = cost(GetParam(), 1), two = cost(GetParam(), 2);
  EXPECT_LE(one.peak, most.peak);
  EXPECT_LE(one.kept, most.kept);
  EXPECT_LE(one.allocations, most.allocations);
  // A second thread needs room for what it works on, and nothing per point.
  EXPECT_LE(two.peak, 1.02 * one.peak);
  EXPECT_LE(two.kept, 1.001 * one.kept);
  EXPECT_LE(two.allocations, 1.02 * one.allocations);
  RecordProperty("peak_bytes_per_point", std::to_string(one.peak));
  RecordProperty("kept_bytes_per_point", std::to_string(one.kept));
  RecordProperty("allocations_per_1000_points", std::to_string(one.allocations));
}

INSTANTIATE_TEST_SUITE_P(Bytes, CostOf, testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace medial
