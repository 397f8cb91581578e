// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <thread>

#include "shapes.h"

namespace medial {
namespace {

TEST(MedialAnalysis, CancelsInEveryStage) {
  const auto mesh = test::torus(150, 80);
  for (const double share : {0.0, 0.3, 0.55, 0.6, 0.7, 0.75, 0.85, 0.93}) {
    Progress progress;
    Thread watcher([&] {
      while (progress.fraction() < share) std::this_thread::yield();
      progress.cancel();
    });
    try {
      MedialAnalysis({mesh.vertices, mesh.triangles}, {.threads = 2}, &progress);
    } catch (const Cancelled&) {
    }
  }
}

TEST(MedialAnalysis, ReportsWhatIsWrong) {
  const auto message = [](std::span<const Vec3> rows,
                          std::span<const Triangle> triangles = {}) -> std::string {
    try {
      MedialAnalysis({rows, triangles}, {}, nullptr);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  const std::vector<Vec3> four{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_EQ(message(four), "");
  auto nan = four;
  nan[2].y = NAN;
  EXPECT_NE(message(nan).find("row 2"), std::string::npos);
  EXPECT_NE(message(std::vector<Vec3>(9, four[1])).find("at least 4 distinct"), std::string::npos);
  EXPECT_NE(message(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).find("one line"),
            std::string::npos);
  EXPECT_NE(
      message(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 4, 0}}).find("one plane"),
      std::string::npos);
  const std::vector<Triangle> bad{{0, 1, 9}};
  EXPECT_NE(message(four, bad).find("found 9 in triangle 0"), std::string::npos);
}

}  // namespace
}  // namespace medial
