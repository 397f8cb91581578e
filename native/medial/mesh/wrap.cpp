// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/wrap.h"

#include <medial/errors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/cgal.h"
#include "base/progress.h"
// clang-format off: CGAL's headers come after what sets CGAL up.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#if __has_include(<CGAL/alpha_wrap_3.h>)
#include <CGAL/alpha_wrap_3.h>
#endif
// clang-format on

namespace medial {

#if __has_include(<CGAL/alpha_wrap_3.h>)
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

struct Cancellable : CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
  explicit Cancellable(const Progress* of) : progress(of) {}
  template <typename Wrapper, typename Gate>
  void before_facet_treatment(const Wrapper&, const Gate&) {
    throw_if_cancelled(progress);
  }
  const Progress* progress;
};

// Maps the bounding box of the rows of faces to one with a diagonal of 1 round the origin.
struct Frame {
  Vec3 middle;
  double diagonal = 0;

  Frame(std::span<const Vec3> rows, std::span<const Triangle> triangles) {
    if (triangles.empty()) return;
    Vec3 low = rows[triangles[0][0]], high = low;
    for (const Triangle& t : triangles) {
      for (const int32_t row : t) {
        const Vec3& p = rows[row];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
    middle = 0.5 * low + 0.5 * high;
    diagonal = distance(low, high);
  }
  Point in(const Vec3& p) const {
    const Vec3 q = (1 / diagonal) * (p - middle);
    return {not_tiny(q.x), not_tiny(q.y), not_tiny(q.z)};
  }
  // Products of shares of the diagonal must not underflow: CGAL would divide by them.
  static double not_tiny(double x) { return std::abs(x) < 1e-40 ? 0 : x; }
  Vec3 out(const Point& p) const { return middle + diagonal * Vec3{p.x(), p.y(), p.z()}; }
};

// Coordinates of at most one are off by as much, so a thinner triangle has no plane: CGAL may never
// end on such.
bool has_area(const Point& a, const Point& b, const Point& c) {
  const double longest = std::max(
      {CGAL::squared_distance(a, b), CGAL::squared_distance(b, c), CGAL::squared_distance(c, a)});
  const double rounding = std::numeric_limits<double>::epsilon();
  const Kernel::Vector_3 normal = CGAL::cross_product(b - a, c - a);
  return normal.squared_length() > rounding * rounding * longest;
}

Wrapping taken(const Mesh& mesh, const Frame& frame) {
  Wrapping found;
  for (const auto v : mesh.vertices()) found.rows.push_back(frame.out(mesh.point(v)));
  for (const auto f : mesh.faces()) {
    Triangle t;
    int corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      t[corner++] = static_cast<int32_t>(v.idx());
    found.triangles.push_back(t);
  }
  return found;
}

}  // namespace

Wrapping wrap(std::span<const Vec3> rows, std::span<const Triangle> triangles, double opening,
              double distance, const Run& run) {
  const Frame frame(rows, triangles);
  if (!(frame.diagonal > 0))
    throw InvalidInputError("Expected faces to wrap, found none with an area");
  std::vector<Point> points;
  points.reserve(rows.size());
  for (const Vec3& p : rows) points.push_back(frame.in(p));
  std::vector<std::array<size_t, 3>> faces;
  faces.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    if (!has_area(points[a], points[b], points[c])) continue;
    faces.push_back({static_cast<size_t>(a), static_cast<size_t>(b), static_cast<size_t>(c)});
  }
  if (faces.empty()) throw InvalidInputError("Expected faces to wrap, found none with an area");
  Mesh mesh;
  CGAL::alpha_wrap_3(points, faces, opening, distance, mesh,
                     CGAL::parameters::visitor(Cancellable(run.progress)));
  return taken(mesh, frame);
}
#else
Wrapping wrap(std::span<const Vec3>, std::span<const Triangle>, double, double, const Run&) {
  throw InvalidInputError(
      "Expected CGAL 5.5 or newer for wrapping, found an older one when this module was compiled; "
      "choose another Inside Decided By");
}
#endif

}  // namespace medial
