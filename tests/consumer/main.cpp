// SPDX-License-Identifier: GPL-3.0-or-later
// The medial axis of a cube of side 8 whose faces are grids of samples.
#include <medial/analysis.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <vector>

int main() {
  std::vector<medial::Vec3> points;
  for (int x = 0; x <= 8; ++x) {
    for (int y = 0; y <= 8; ++y) {
      for (int z = 0; z <= 8; ++z) {
        if (x % 8 == 0 || y % 8 == 0 || z % 8 == 0) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  try {
    const medial::MedialAnalysis analysis({points});  // everything costly, once
    const medial::Thresholds published, stricter{.theta = 0.8, .rho = 4};
    for (const auto& thresholds : {published, stricter}) {
      const medial::MedialMesh axis = analysis.extract({thresholds});  // milliseconds
      std::printf("theta %.3f, rho %g: %zu facets, largest ball %g\n", thresholds.theta,
                  thresholds.rho, axis.theta.size(),
                  *std::max_element(axis.radius.begin(), axis.radius.end()));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
