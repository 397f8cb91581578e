// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/surface.h"

#include <string>

#include "base/rows.h"

namespace medial {

void require_corners(std::span<const Triangle> triangles, size_t rows) {
  for (size_t i = 0; i < triangles.size(); ++i) {
    for (const int32_t corner : triangles[i]) {
      if (corner >= 0 && static_cast<size_t>(corner) < rows) continue;
      throw InvalidInputError("Expected triangle corners below " + std::to_string(rows) +
                              ", found " + std::to_string(corner) + " in triangle " +
                              std::to_string(i) + "; rebuild the faces.");
    }
  }
}

Surface make_surface(std::span<const Triangle> triangles, std::span<const int32_t> vertex_of_row,
                     int32_t vertices, const Run& run) {
  Surface surface;
  surface.triangles.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    const Triangle t{vertex_of_row[i], vertex_of_row[j], vertex_of_row[k]};
    if (has_three_corners(t)) surface.triangles.push_back(t);
  }
  const auto fans = rows_containing(std::span<const Triangle>(surface.triangles), vertices, run);
  surface.boundary = boundary_edges(surface.triangles, fans, run);
  return surface;
}

int64_t open_edges(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                   const Run& run) {
  require_corners(triangles, rows.size());
  require_finite(rows, "point");
  std::vector<int32_t> apart = all_rows(rows.size());
  // A surface that is closed by its rows stays closed when some rows become one vertex, because as
  // many edges lead there and back as before.
  if (make_surface(triangles, apart, static_cast<int32_t>(rows.size()), run).closed()) return 0;
  const DistinctRows distinct = distinct_rows(rows, "point", run);
  return make_surface(triangles, distinct.point_of_row, distinct.count(), run).open_edges();
}

int64_t Surface::open_edges() const {
  int64_t count = 0;
  for (size_t i = 0; i < boundary.size(); ++i) count += i == 0 || boundary[i] != boundary[i - 1];
  return count;
}

}  // namespace medial
