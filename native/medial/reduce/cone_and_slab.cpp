// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/cone_and_slab.h"

namespace medial {
namespace {

// Holds the gradient of the radius in the plane of a triangle, and the normal of the plane.
struct Slope {
  bool exists = false;
  Vec3 normal, gradient;
};

Slope slope_of(const Sphere& a, const Sphere& b, const Sphere& c) {
  const Vec3 u = b.centre - a.centre, v = c.centre - a.centre, n = cross(u, v);
  const double area = squared_length(n);
  if (!(area > 0)) return {};
  // The gradient g is the vector of the plane with u . g = rise along u, and v . g = rise along v.
  const Vec3 gradient =
      (1 / area) * ((b.radius - a.radius) * cross(v, n) + (c.radius - a.radius) * cross(n, u));
  return {squared_length(gradient) < 1, (1 / std::sqrt(area)) * n, gradient};
}

NearestOfEnvelope nearest_of_ball(const Sphere& a, const Vec3& query) {
  return {distance(query, a.centre) - a.radius, {1, 0, 0}};
}

// Returns the nearest ball of a cone: it is where the generator through the query leaves the axis.
NearestOfEnvelope nearest_of_cone(const Sphere& a, const Sphere& b, const Vec3& query) {
  const Vec3 along = b.centre - a.centre;
  const double whole = length(along), rise = b.radius - a.radius;
  double share = rise > 0 ? 1 : 0;  // if one ball contains the other
  if (std::abs(rise) < whole) {
    const Vec3 axis = (1 / whole) * along, away = query - a.centre;
    const double at = dot(away, axis), height = length(away - at * axis), k = rise / whole;
    share = std::clamp((at + height * k / std::sqrt(1 - k * k)) / whole, 0.0, 1.0);
  }
  const double radius = a.radius + share * rise;
  return {distance(query, a.centre + share * along) - radius, {1 - share, share, 0}};
}

NearestOfEnvelope nearest_of_sides(std::span<const Sphere> s, const Vec3& query) {
  NearestOfEnvelope best;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const NearestOfEnvelope side = nearest_of_cone(s[i], s[j], query);
    if (!(side.distance < best.distance)) continue;
    best = {side.distance, {}};
    best.shares[i] = side.shares[0];
    best.shares[j] = side.shares[1];
  }
  return best;
}

NearestOfEnvelope nearest_of_slab(std::span<const Sphere> s, const Vec3& query) {
  const Slope slope = slope_of(s[0], s[1], s[2]);
  if (!slope.exists) return nearest_of_sides(s, query);
  const Vec3 away = query - s[0].centre;
  const double height = dot(away, slope.normal);
  const double lean = std::abs(height) / std::sqrt(1 - squared_length(slope.gradient));
  const Vec3 foot = away - height * slope.normal + lean * slope.gradient;
  const Vec3 u = s[1].centre - s[0].centre, v = s[2].centre - s[0].centre, n = cross(u, v);
  const double area = squared_length(n);
  const double second = dot(cross(foot, v), n) / area, third = dot(cross(u, foot), n) / area;
  const double first = 1 - second - third;
  if (!(first >= 0 && second >= 0 && third >= 0)) return nearest_of_sides(s, query);
  const double radius = s[0].radius + dot(foot, slope.gradient);
  return {distance(query, s[0].centre + foot) - radius, {first, second, third}};
}

}  // namespace

NearestOfEnvelope nearest_ball(std::span<const Sphere> spheres, const Vec3& query) {
  if (spheres.size() == 1) return nearest_of_ball(spheres[0], query);
  if (spheres.size() == 2) return nearest_of_cone(spheres[0], spheres[1], query);
  return nearest_of_slab(spheres, query);
}

TangentNormals tangent_normals(const Sphere& a, const Sphere& b, const Sphere& c) {
  const Slope slope = slope_of(a, b, c);
  if (!slope.exists) return {};
  const Vec3 up = std::sqrt(1 - squared_length(slope.gradient)) * slope.normal;
  return {true, {up - slope.gradient, -up - slope.gradient}};
}

}  // namespace medial
