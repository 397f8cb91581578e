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
// The cosine of the angle by which a sheet may turn at an edge: 120 degrees.
constexpr double kFold = -0.5;

using Places = std::array<Vec3, 3>;

struct Plane {
  Vec3 normal;        // unit
  double height = 0;  // of the triangle, as a share of its longest edge
};

Plane plane_of(const Places& p) {
  const Vec3 across = cross(p[1] - p[0], p[2] - p[0]);
  const double area = length(across);
  const double longest = std::max(
      {squared_length(p[1] - p[0]), squared_length(p[2] - p[0]), squared_length(p[2] - p[1])});
  return area > 0 ? Plane{(1 / area) * across, area / longest} : Plane{};
}

Places places_of(const EvenMesh& even, const Triangle& t) {
  return {even.position[t[0]], even.position[t[1]], even.position[t[2]]};
}

// Returns 1 if two triangles go along their common edge in opposite directions, as triangles do
// that are turned alike; else -1.
double alike(const Triangle& s, const Triangle& t, int32_t a, int32_t b) {
  const auto goes_on = [a, b](const Triangle& triangle) {
    return triangle[(corner_of(triangle, a) + 1) % 3] == b;
  };
  return goes_on(s) != goes_on(t) ? 1 : -1;
}

// The normals that triangles would have if one of their corners moved.
class Moved {
 public:
  Moved(const EvenMesh& even, int32_t v, const Vec3& place) : e_(even), v_(v), place_(place) {}

  Vec3 normal(int32_t t) const {
    const Triangle& corners = e_.mesh.triangle(t);
    if (corners[0] != v_ && corners[1] != v_ && corners[2] != v_) return e_.normal[t];
    Places places = places_of(e_, corners);
    places[corner_of(corners, v_)] = place_;
    const Plane plane = plane_of(places);
    return plane.height < kNeedle ? e_.normal[t] : plane.normal;
  }

  // Returns whether the sheet would fold at an edge of a triangle at which it does not yet.
  bool folds(int32_t t, const Vec3& normal_of_t, int32_t a, int32_t b) const {
    const auto& two = e_.mesh.triangles_at(a, b);
    if (two.size() != 2) return false;
    const int32_t other = two[0] == t ? two[1] : two[0];
    const double sign = alike(e_.mesh.triangle(t), e_.mesh.triangle(other), a, b);
    return sign * dot(normal_of_t, normal(other)) < kFold &&
           sign * dot(e_.normal[t], e_.normal[other]) >= kFold;
  }

 private:
  const EvenMesh& e_;
  int32_t v_;
  const Vec3& place_;
};

}  // namespace

bool folds(const EvenMesh& even, int32_t v, const Vec3& place) {
  const Moved moved(even, v, place);
  bool found = false;
  even.mesh.for_triangles(v, [&](int32_t t) {
    if (found) return;
    const Vec3 normal = moved.normal(t);
    const Triangle& c = even.mesh.triangle(t);
    for (int i = 0; i < 3; ++i) found = found || moved.folds(t, normal, c[i], c[(i + 1) % 3]);
  });
  return found;
}

bool keeps_side(const EvenMesh& even, int32_t triangle, int32_t corner, const Vec3& place) {
  const Triangle& corners = even.mesh.triangle(triangle);
  Places places = places_of(even, corners);
  const Plane before = plane_of(places);
  places[corner_of(corners, corner)] = place;
  const Plane after = plane_of(places);
  const double turn = dot(after.normal, even.normal[triangle]);
  if (after.height >= kNeedle) return turn > kMostTurn;
  return before.height < kNeedle && after.height >= before.height && turn >= 0;
}

bool keeps_sides(const EvenMesh& even, int32_t v, const Vec3& place) {
  bool keeps = true;
  even.mesh.for_triangles(v, [&](int32_t t) { keeps = keeps && keeps_side(even, t, v, place); });
  return keeps && !folds(even, v, place);
}

bool can_collapse(const EvenMesh& even, int32_t from, int32_t to) {
  if (!even.mesh.can_collapse(from, to)) return false;
  const Vec3& place = even.position[to];
  bool keeps = true;
  even.mesh.for_triangles(from, [&](int32_t t) {
    const Edge others = link_of(even.mesh.triangle(t), from);
    keeps = keeps && (others[0] == to || others[1] == to || keeps_side(even, t, from, place));
  });
  return keeps && !folds(even, from, place);
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
