// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/buried.h"

#include <string>

#include "base/rows.h"
#include "base/text.h"
#include "inside/winding_number.h"

namespace medial {
namespace {

void check(std::span<const Vec3> points, std::span<const Vec3> normals, double offset) {
  require_finite(points, "point");
  require_finite(normals, "normal");
  require_one_each(normals.size(), points.size(), "one normal per point",
                   "points; pass all of them");
  if (!(offset > 0 && offset < HUGE_VAL)) {
    throw InvalidInputError("Expected a positive offset, found " + std::to_string(offset) +
                            "; a small part of the spacing will do.");
  }
}

// Separates inside from outside at one place after the other; this is fast if little surface is
// between successive places.
class WindingFollower {
 public:
  explicit WindingFollower(const WindingNumber& winding) : winding_(winding) {}

  bool is_inside(const Vec3& query) {
    closed_ = started_ ? winding_.closed_from(last_, closed_, query) : winding_.closed(query);
    started_ = true;
    last_ = query;
    return winding_.is_inside(query, closed_);
  }

 private:
  const WindingNumber& winding_;
  Vec3 last_;
  int closed_ = 0;
  bool started_ = false;
};

}  // namespace

std::vector<uint8_t> buried(std::span<const Vec3> points, std::span<const Vec3> normals,
                            double offset, std::span<const Vec3> vertices,
                            std::span<const Triangle> triangles, const Run& run) {
  begin_stage(run.progress, "Buried surface", 0, 1);
  check(points, normals, offset);
  require_corners(triangles, vertices.size());
  const DistinctRows corners = distinct_rows(vertices, "vertex", run);
  const Surface surface = make_surface(triangles, corners.point_of_row, corners.count(), run);
  const WindingNumber winding(corners.points, surface.triangles, surface.boundary, run.progress);
  const auto order = hilbert_order(points, run);
  std::vector<uint8_t> result(points.size(), 0);
  parallel_chunks(static_cast<int64_t>(order.size()), run, [&](int64_t begin, int64_t end, int) {
    WindingFollower above(winding), below(winding);
    for (int64_t i = begin; i < end; ++i) {
      const int32_t row = order[i];
      if (normals[row] == Vec3{}) continue;
      const Vec3 step = offset * normals[row];
      result[row] = above.is_inside(points[row] + step) == below.is_inside(points[row] - step);
    }
  });
  advance(run.progress, 1);
  return result;
}

}  // namespace medial
