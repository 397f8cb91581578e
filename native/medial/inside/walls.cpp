// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/walls.h"

#include <string>

#include "base/rows.h"
#include "base/text.h"
#include "inside/ray_crossings.h"
#include "inside/surface.h"
#include "inside/winding_number.h"

namespace medial {
namespace {

constexpr double kFacing =
    0.8660254037844386;  // the cosine of 30 degrees; chosen: axis, midsurface

void check(std::span<const Vec3> points, std::span<const Vec3> normals,
           std::span<const double> reach) {
  require_finite(points, "point");
  require_finite(normals, "normal");
  if (normals.size() != points.size() || reach.size() != points.size()) {
    throw InvalidInputError("Expected one normal and one reach per point, found " +
                            std::to_string(normals.size()) + " and " +
                            std::to_string(reach.size()) + " for " + std::to_string(points.size()) +
                            " points; pass all of them.");
  }
  for (const double r : reach) {
    if (r > 0 && r < HUGE_VAL) continue;
    throw InvalidInputError("Expected positive reaches, found " + text(r) + "; correct it.");
  }
}

double distance_of_wall(std::span<RayCrossings::Hit> hits) {
  std::sort(hits.begin(), hits.end());
  int depth = 1;
  for (const auto& hit : hits) {
    depth += hit.cosine > 0 ? -1 : 1;
    if (depth == 0) return hit.cosine >= kFacing ? hit.at : HUGE_VAL;
  }
  return HUGE_VAL;
}

}  // namespace

std::vector<double> wall_distances(std::span<const Vec3> points, std::span<const Vec3> normals,
                                   std::span<const double> reach, std::span<const Vec3> vertices,
                                   std::span<const Triangle> triangles, const Run& run) {
  begin_stage(run.progress, "Walls", 0, 1);
  check(points, normals, reach);
  require_finite(vertices, "vertex");
  require_corners(triangles, vertices.size());
  const RayCrossings crossings(soup(vertices, triangles), run.progress);
  std::vector<double> result(points.size(), HUGE_VAL);
  parallel_chunks(static_cast<int64_t>(points.size()), run, [&](int64_t begin, int64_t end, int) {
    std::vector<RayCrossings::Hit> hits;
    for (int64_t i = begin; i < end; ++i) {
      if (normals[i] == Vec3{}) continue;
      crossings.hits(points[i], -normals[i], reach[i], hits);
      result[i] = distance_of_wall(hits);
    }
  });
  advance(run.progress, 1);
  return result;
}

}  // namespace medial
