// SPDX-License-Identifier: GPL-3.0-or-later
#include "rivals/remark.h"

#include "axis/edge_ends.h"

namespace medial {
namespace {

// Returns, relative to p, where the Voronoi edge dual to the triangle (p, p + a, p + b) crosses the
// plane through p normal to the pole vector: a corner of the tangent polygon (Definition 2).
Vec3 polygon_corner(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& pole) {
  const double aa = squared_length(a), bb = squared_length(b);
  const double twice_area = length(cross(a, b));
  const Vec3 centre = (1 / (2 * twice_area)) * (aa * cross(b, normal) + bb * cross(normal, a));
  return centre - (dot(centre, pole) / dot(normal, pole)) * normal;
}

// Returns for each sample the distance to the farthest corner of its tangent polygon, infinite
// without corners.
Array<double> polygon_reaches(std::span<const Vec3> points, const Umbrellas& umbrellas,
                              const Array<Vec3>& normals, std::span<const Vec3> poles,
                              const Run& run) {
  auto reach = array<double>(static_cast<size_t>(umbrellas.size()), HUGE_VAL, run);
  parallel_for(umbrellas.size(), run, [&](int64_t p) {
    if (!umbrellas[p].empty()) reach[p] = 0;
    for (int64_t i = umbrellas.offsets[p]; i < umbrellas.offsets[p + 1]; ++i) {
      const auto& [a, b] = umbrellas.items[i];
      const Vec3 corner =
          polygon_corner(normals[i], points[a] - points[p], points[b] - points[p], poles[p]);
      reach[p] = std::max(reach[p], length(corner));
    }
  });
  return reach;
}

}  // namespace

Significance significance_by_remark(std::span<const Vec3> points, const Edges& edges,
                                    const Umbrellas& umbrellas, const Poles& poles, Against against,
                                    const Run& run) {
  const bool by_pole = against == Against::pole || against == Against::pole_and_polygon;
  const bool by_polygon = against == Against::polygon || against == Against::pole_and_polygon;
  UmbrellaShapes shapes = umbrella_shapes(points, umbrellas, run);
  Array<double> reach;
  if (by_polygon) reach = polygon_reaches(points, umbrellas, shapes.normal, poles.vector, run);
  const auto measure = [&](int32_t p, int32_t q, const Vec3& direction, double size) {
    EdgeEnd end = edge_end(p, q, direction, size, umbrellas, shapes);
    if (umbrellas[p].empty()) return end;
    if (by_pole) {
      end.sine = std::abs(dot(normalized(poles.vector[p]), direction));
      end.umbrella = false;  // without umbrellas every edge is tried
    }
    if (by_polygon) end.ratio = size / reach[p];
    return end;
  };
  Significance result = significance_of_ends(points, edges, measure, run);
  result.spacing = std::move(shapes.radius);
  return result;
}

}  // namespace medial
