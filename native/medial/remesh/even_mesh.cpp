// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh/even_mesh.h"

#include <algorithm>

namespace medial {
namespace {

// The cosine of the angle by which no change may turn a triangle, so that sheets do not fold: 70
// degrees.
constexpr double kMostTurn = 0.342;
// A triangle lower than this share of its longest edge is a needle, whose normal is rounding and
// noise of the samples.
constexpr double kNeedle = 0.02;

using Places = std::array<Vec3, 3>;

struct Plane {
  Vec3 normal;        // unit
  double height = 0;  // of the triangle, as a share of its longest edge
};

Plane plane_of(const Places& p) {
  const Vec3 across = cross(p[1] - p[0], p[2] - p[0]);
  const double area = length(across);
  const double longest = std::max({squared_length(p[1] - p[0]), squared_length(p[2] - p[0]),
                                   squared_length(p[2] - p[1])});
  return area > 0 ? Plane{(1 / area) * across, area / longest} : Plane{};
}

Places places_of(const EvenMesh& even, const Triangle& t) {
  return {even.position[t[0]], even.position[t[1]], even.position[t[2]]};
}

}  // namespace

bool keeps_side(const EvenMesh& even, int32_t triangle, int32_t corner, const Vec3& place) {
  const Triangle& corners = even.mesh.triangle(triangle);
  Places places = places_of(even, corners);
  const Plane before = plane_of(places);
  places[corner_of(corners, corner)] = place;
  const Plane after = plane_of(places);
  if (after.height < kNeedle) return before.height < kNeedle && after.height >= before.height;
  return dot(after.normal, even.normal[triangle]) > kMostTurn;
}

bool keeps_sides(const EvenMesh& even, int32_t v, const Vec3& place) {
  bool keeps = true;
  even.mesh.for_triangles(v, [&](int32_t t) { keeps = keeps && keeps_side(even, t, v, place); });
  return keeps;
}

void settle_normal(EvenMesh& even, int32_t triangle) {
  if (even.mesh.is_gone(triangle)) return;
  const Plane plane = plane_of(places_of(even, even.mesh.triangle(triangle)));
  if (plane.height >= kNeedle) even.normal[triangle] = plane.normal;
}

void move(EvenMesh& even, int32_t v, const Vec3& place) {
  even.position[v] = place;
  even.mesh.for_triangles(v, [&](int32_t t) { settle_normal(even, t); });
}

std::optional<std::array<Vec3, 2>> normals_of_flip(const EvenMesh& even, int32_t a, int32_t b) {
  const auto& two = even.mesh.triangles_at(a, b);
  const std::array<int32_t, 2> given_up{b, a};
  std::array<Vec3, 2> normals;
  for (int i = 0; i < 2; ++i) {
    const int32_t replaced = even.mesh.third_corner(two[1 - i], a, b);
    Places places = places_of(even, even.mesh.triangle(two[i]));
    places[corner_of(even.mesh.triangle(two[i]), given_up[i])] = even.position[replaced];
    const Plane plane = plane_of(places);
    if (plane.height < kNeedle || !(dot(plane.normal, even.normal[two[i]]) > kMostTurn)) return {};
    normals[i] = plane.normal;
  }
  return normals;
}

Vec3 normal_at(const EvenMesh& even, int32_t v) {
  Vec3 sum;
  even.mesh.for_triangles(v, [&](int32_t t) {
    const Vec3& normal = even.normal[t];
    sum = dot(sum, normal) < 0 ? sum - normal : sum + normal;
  });
  return normalized(sum);
}

}  // namespace medial
