// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/covered_solid.h"

#include <string>

#include "base/text.h"

namespace medial {
namespace {

// These are the most places of a lattice in the box of the solid. An open surface needs a query for
// each of them.
constexpr int64_t kMost = 1 << 24, kMostOpen = 1 << 20;

}  // namespace

CoveredSolid::CoveredSolid(std::span<const Vec3> rows, std::span<const Triangle> faces,
                           std::span<const Vec3> others, const Run& run)
    : frame(frame_of(rows, others)),
      vertices(distinct_rows(frame.inward(rows), "vertex", run)),
      surface(make_surface(faces, vertices.point_of_row, vertices.count(), run)),
      winding(vertices.points, surface.triangles, surface.boundary, run.progress) {
  if (surface.triangles.empty()) {
    throw DegenerateInputError(
        "Expected faces that enclose a volume, found none with three corners; pass a surface.");
  }
  for (const Triangle& t : surface.triangles) {
    for (const int32_t corner : t) box.add(vertices.points[corner]);
  }
}

SolidLattice CoveredSolid::lattice(int64_t places, const Run& run) const {
  SolidLattice found(winding, box, places, surface.closed() ? kMost : kMostOpen, run);
  if (found.count() == 0) {
    throw DegenerateInputError(
        "Expected faces that enclose a volume, found no place of a lattice inside; close them, or "
        "turn them outward.");
  }
  return found;
}

void require_amounts(int64_t count, int64_t places, double tolerance, const char* solid) {
  if (count < 1 || places < 1) {
    throw InvalidInputError("Expected at least one " + std::string(solid) +
                            " and one place, found " + std::to_string(std::min(count, places)) +
                            "; ask for more.");
  }
  if (!(tolerance >= 0 && tolerance <= kLargestCoordinate)) {
    throw InvalidInputError("Expected a finite tolerance of 0 or more, found " + text(tolerance) +
                            "; correct it.");
  }
}

}  // namespace medial
