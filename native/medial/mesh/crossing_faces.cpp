// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/crossing_faces.h"

#include <algorithm>
#include <array>

#include "base/cgal.h"
// clang-format off: CGAL's headers come after what sets CGAL up.
#include <CGAL/box_intersection_d.h>
// clang-format on
#include "base/filtered_kernel.h"

namespace medial {
namespace {

using Point = FilteredKernel::Point_3;
using Corners = std::array<Point, 3>;
using BoundingBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int32_t>;

struct Enough {};  // ends the search for boxes that meet

Corners corners_of(std::span<const Vec3> points, const Triangle& triangle) {
  const auto corner = [&](int i) {
    const Vec3& p = points[triangle[i]];
    return Point(p.x, p.y, p.z);
  };
  return {corner(0), corner(1), corner(2)};
}

// Returns whether a segment passes through the inside of a triangle. One from a corner of it does
// not, which arithmetic would find out late, as the corner is exactly in the plane.
bool pierces(const Point& from, const Point& to, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  for (const Point& corner : triangle) {
    if (corner == from || corner == to) return false;
  }
  const FilteredKernel::Orientation_3 orientation;
  const auto side = orientation(a, b, c, from);
  if (side == CGAL::COPLANAR || orientation(a, b, c, to) != -side) return false;
  const auto turn = orientation(from, to, a, b);
  return turn != CGAL::COPLANAR && orientation(from, to, b, c) == turn &&
         orientation(from, to, c, a) == turn;
}

bool any_side_pierces(const Corners& sides, const Corners& triangle) {
  return pierces(sides[0], sides[1], triangle) || pierces(sides[1], sides[2], triangle) ||
         pierces(sides[2], sides[0], triangle);
}

std::vector<BoundingBox> boxes_of(std::span<const Corners> triangles) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(triangles.size());
  for (size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    boxes.emplace_back(a.bbox() + b.bbox() + c.bbox(), static_cast<int32_t>(i));
  }
  return boxes;
}

}  // namespace

std::vector<Edge> crossing_faces(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                 int64_t most) {
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  for (const Triangle& triangle : triangles) corners.push_back(corners_of(points, triangle));
  std::vector<Edge> found;
  int64_t compared = 0;
  const auto compare = [&](const BoundingBox& s, const BoundingBox& t) {
    if (++compared > most) throw Enough{};
    const auto [first, second] = std::minmax({s.info(), t.info()});
    if (any_side_pierces(corners[first], corners[second]) ||
        any_side_pierces(corners[second], corners[first])) {
      found.push_back({first, second});
    }
  };
  std::vector<BoundingBox> boxes = boxes_of(corners);
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), compare);
  } catch (const Enough&) {
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace medial
