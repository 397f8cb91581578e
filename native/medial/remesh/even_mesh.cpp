// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh/even_mesh.h"

#include <algorithm>

namespace medial {
namespace {

// The cosine of the angle by which no change may turn a triangle, so that sheets do not fold: 70
// degrees.
constexpr double kMostTurn = 0.342;  // chosen: axis
// A triangle lower than this share of its longest edge is a needle, whose normal is rounding and
// noise of the samples.
constexpr double kNeedle = 0.02;  // chosen: axis
// The cosine of the angle by which a sheet may turn at an edge: 120 degrees.
constexpr double kFold = -0.5;  // chosen: axis

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

// The triangles at a vertex, as they would be if it moved.
class MovedStar {
 public:
  MovedStar(const EvenMesh& even, int32_t v, const Vec3& place) : e_(even) {
    e_.mesh.for_triangles(v, [&](int32_t t) {
      const Triangle& corners = e_.mesh.triangle(t);
      const int at = corner_of(corners, v);
      Places places = places_of(e_, corners);
      places[at] = place;
      const Plane plane = plane_of(places);
      const Vec3 normal = plane.height < kNeedle ? e_.normal[t] : plane.normal;
      star_.push_back({t, corners[(at + 1) % 3], corners[(at + 2) % 3], normal});
    });
  }

  // Returns whether a sheet would fold at an edge of the triangles at which it does not yet.
  bool folds() const {
    return std::any_of(star_.begin(), star_.end(), [&](const Moved& one) {
      return folds_across(one) || folds_at(one, one.next) || folds_at(one, one.last);
    });
  }

 private:
  struct Moved {
    int32_t triangle, next, last;  // its corners after the vertex
    Vec3 normal;
  };

  // At the edge that is not at the vertex.
  bool folds_across(const Moved& one) const {
    const auto& two = e_.mesh.triangles_at(one.next, one.last);
    if (two.size() != 2) return false;
    const int32_t other = two[0] == one.triangle ? two[1] : two[0];
    const Triangle& corners = e_.mesh.triangle(other);
    const bool alike = corners[(corner_of(corners, one.next) + 1) % 3] != one.last;
    return folds(one, other, e_.normal[other], alike);
  }

  // At the edge to a corner.
  bool folds_at(const Moved& one, int32_t corner) const {
    const Moved* other = nullptr;
    for (const Moved& beside : star_) {
      if (&beside == &one || (beside.next != corner && beside.last != corner)) continue;
      if (other) return false;
      other = &beside;
    }
    if (!other) return false;
    const bool alike = (one.next == corner) != (other->next == corner);
    return folds(one, other->triangle, other->normal, alike);
  }

  // Triangles that are turned alike go along their common edge in opposite directions.
  bool folds(const Moved& one, int32_t other, const Vec3& normal_of_other, bool alike) const {
    const double sign = alike ? 1 : -1;
    return sign * dot(one.normal, normal_of_other) < kFold &&
           sign * dot(e_.normal[one.triangle], e_.normal[other]) >= kFold;
  }

  const EvenMesh& e_;
  std::vector<Moved> star_;
};

}  // namespace

bool folds(const EvenMesh& even, int32_t v, const Vec3& place) {
  return MovedStar(even, v, place).folds();
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
