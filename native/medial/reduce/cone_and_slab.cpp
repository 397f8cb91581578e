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

}  // namespace

EnvelopeOfSpheres::EnvelopeOfSpheres(std::span<const Sphere> spheres)
    : count_(static_cast<int>(spheres.size())) {
  std::copy(spheres.begin(), spheres.end(), spheres_.begin());
  if (count_ == 2) prepare_cone(0);
  if (count_ < 3) return;
  for (int i = 0; i < 3; ++i) prepare_cone(i);
  u_ = spheres_[1].centre - spheres_[0].centre;
  v_ = spheres_[2].centre - spheres_[0].centre;
  n_ = cross(u_, v_);
  area_ = squared_length(n_);
  const Slope slope = slope_of(spheres_[0], spheres_[1], spheres_[2]);
  has_planes_ = slope.exists;
  normal_ = slope.normal;
  gradient_ = slope.gradient;
  flat_ = std::sqrt(1 - squared_length(gradient_));
}

void EnvelopeOfSpheres::prepare_cone(int first) {
  const Sphere &a = spheres_[first], &b = spheres_[(first + 1) % 3];
  Cone& cone = cones_[first];
  cone.along = b.centre - a.centre;
  cone.whole = length(cone.along);
  cone.rise = b.radius - a.radius;
  cone.one_contains_other = !(std::abs(cone.rise) < cone.whole);
  if (cone.one_contains_other) return;
  cone.axis = (1 / cone.whole) * cone.along;
  cone.ratio = cone.rise / cone.whole;
  cone.flat = std::sqrt(1 - cone.ratio * cone.ratio);
}

// The nearest ball of a cone is where the generator through the query leaves the axis.
NearestOfEnvelope EnvelopeOfSpheres::nearest_of_cone(int first, const Vec3& query) const {
  const Sphere& a = spheres_[first];
  const Cone& cone = cones_[first];
  double share = cone.rise > 0 ? 1 : 0;  // if one ball contains the other
  if (!cone.one_contains_other) {
    const Vec3 away = query - a.centre;
    const double at = dot(away, cone.axis), height = length(away - at * cone.axis);
    share = std::clamp((at + height * cone.ratio / cone.flat) / cone.whole, 0.0, 1.0);
  }
  const double radius = a.radius + share * cone.rise;
  return {distance(query, a.centre + share * cone.along) - radius, {1 - share, share, 0}};
}

NearestOfEnvelope EnvelopeOfSpheres::nearest_of_sides(const Vec3& query) const {
  NearestOfEnvelope best;
  for (int i = 0; i < 3; ++i) {
    const NearestOfEnvelope side = nearest_of_cone(i, query);
    if (!(side.distance < best.distance)) continue;
    best = {side.distance, {}};
    best.shares[i] = side.shares[0];
    best.shares[(i + 1) % 3] = side.shares[1];
  }
  return best;
}

NearestOfEnvelope EnvelopeOfSpheres::nearest_of_slab(const Vec3& query) const {
  if (!has_planes_) return nearest_of_sides(query);
  const Sphere& a = spheres_[0];
  const Vec3 away = query - a.centre;
  const double height = dot(away, normal_);
  const double lean = std::abs(height) / flat_;
  const Vec3 foot = away - height * normal_ + lean * gradient_;
  const double second = dot(cross(foot, v_), n_) / area_, third = dot(cross(u_, foot), n_) / area_;
  const double first = 1 - second - third;
  if (!(first >= 0 && second >= 0 && third >= 0)) return nearest_of_sides(query);
  const double radius = a.radius + dot(foot, gradient_);
  return {distance(query, a.centre + foot) - radius, {first, second, third}};
}

NearestOfEnvelope EnvelopeOfSpheres::nearest(const Vec3& query) const {
  if (count_ == 1) return {distance(query, spheres_[0].centre) - spheres_[0].radius, {1, 0, 0}};
  return count_ == 2 ? nearest_of_cone(0, query) : nearest_of_slab(query);
}

TangentNormals tangent_normals(const Sphere& a, const Sphere& b, const Sphere& c) {
  const Slope slope = slope_of(a, b, c);
  if (!slope.exists) return {};
  const Vec3 up = std::sqrt(1 - squared_length(slope.gradient)) * slope.normal;
  return {true, {up - slope.gradient, -up - slope.gradient}};
}

}  // namespace medial
