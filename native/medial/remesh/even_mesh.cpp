// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh/even_mesh.h"

#include <algorithm>

#include "base/rows.h"
#include "base/short_list.h"

namespace medial {
namespace {

// The cosine of the angle by which no change may turn a triangle, so that sheets do not fold: 70
// degrees.
constexpr double kMostTurn = 0.342;  // chosen: axis
// A triangle lower than this share of its longest edge is a needle, whose normal is rounding and
// noise of the samples.
constexpr double kNeedle = 0.02;  // chosen: axis
// A triangle lower than this share is flat: rounding of 6e-8 in edges of 1/300 of the whole.
constexpr double kFlat = 2e-5;  // derived: rounding
// The cosine of the angle by which a sheet may turn at an edge: 120 degrees.
constexpr double kFold = -0.5;  // chosen: axis

using Places = std::array<Vec3, 3>;

struct Plane {
  Vec3 normal;        // unit
  double height = 0;  // of the triangle, as a share of its longest edge
};

// A triangle whose corners are on a line, up to the rounding of float32, has no side.
Plane plane_of(const Places& p) {
  const Vec3 across = cross(p[1] - p[0], p[2] - p[0]);
  const double area = length(across);
  const double longest = std::max(
      {squared_length(p[1] - p[0]), squared_length(p[2] - p[0]), squared_length(p[2] - p[1])});
  return area <= kFlat * longest ? Plane{} : Plane{(1 / area) * across, area / longest};
}

Places places_of(const EvenMesh& even, const Triangle& t) {
  return {even.position[t[0]], even.position[t[1]], even.position[t[2]]};
}

bool contains(std::span<const int32_t> all, int32_t one) {
  return std::ranges::find(all, one) != all.end();
}

// The triangles at a vertex, as they would be if it moved.
class MovedStar {
 public:
  // Triangles at the edges to `without` vanish, and keep no side. Needles get no flatter, unless
  // `is_exact`.
  MovedStar(const EvenMesh& even, int32_t v, const Vec3& place, std::span<const int32_t> without,
            bool is_exact = false)
      : e_(even), is_exact_(is_exact) {
    e_.mesh.for_triangles(v, [&](int32_t t) {
      if (!keeps_sides_) return;
      const Triangle& corners = e_.mesh.triangle(t);
      const int at = corner_of(corners, v);
      const int32_t next = corners[(at + 1) % 3], last = corners[(at + 2) % 3];
      Places places = places_of(e_, corners);
      places[at] = place;
      const Plane plane = plane_of(places);
      const bool vanishes = contains(without, next) || contains(without, last);
      keeps_sides_ = vanishes || keeps_side(t, plane);
      const bool keeps_normal = vanishes || plane.height < kNeedle;
      star_.push_back({t, next, last, keeps_normal ? e_.normal[t] : plane.normal});
    });
  }

  bool keeps_sides() const { return keeps_sides_; }

  // Returns whether all triangles would keep their side, and no sheet would fold at an edge of them
  // at which it does not yet.
  bool is_sound() const {
    if (!keeps_sides_) return false;
    for (auto one = star_.begin(); one != star_.end(); ++one) {
      const bool folded =
          folds_across(*one) || std::any_of(one + 1, star_.end(), [&](const Moved& other) {
            return folds_between(*one, other);
          });
      if (folded) return false;
    }
    return true;
  }

 private:
  struct Moved {
    int32_t triangle, next, last;  // its corners after the vertex
    Vec3 normal;
  };

  bool keeps_side(int32_t t, const Plane& after) const {
    const double turn = dot(after.normal, e_.normal[t]);
    if (after.height >= kNeedle) return turn > kMostTurn;
    const double before = plane_of(places_of(e_, e_.mesh.triangle(t))).height;
    if (before >= kNeedle) return false;
    return (is_exact_ && turn > kMostTurn) || (after.height >= before && turn >= 0);
  }

  // At the edge that is not at the vertex.
  bool folds_across(const Moved& one) const {
    const int32_t other = e_.mesh.across(one.triangle, one.next, one.last);
    if (other < 0) return false;
    const Triangle& corners = e_.mesh.triangle(other);
    const bool alike = corners[(corner_of(corners, one.next) + 1) % 3] != one.last;
    return folds(one, other, e_.normal[other], alike);
  }

  bool folds_between(const Moved& one, const Moved& other) const {
    return folds_at(one.next, one, other) || folds_at(one.last, one, other);
  }

  // At an edge to a corner that two triangles share, and no third one.
  bool folds_at(int32_t corner, const Moved& one, const Moved& other) const {
    if (other.next != corner && other.last != corner) return false;
    const bool alike = (one.next == corner) != (other.next == corner);
    return folds(one, other.triangle, other.normal, alike) && uses(corner) == 2;
  }

  int64_t uses(int32_t corner) const {
    return std::count_if(star_.begin(), star_.end(), [corner](const Moved& one) {
      return one.next == corner || one.last == corner;
    });
  }

  // Triangles that are turned alike go along their common edge in opposite directions.
  bool folds(const Moved& one, int32_t other, const Vec3& normal_of_other, bool alike) const {
    const double sign = alike ? 1 : -1;
    return sign * dot(one.normal, normal_of_other) < kFold &&
           sign * dot(e_.normal[one.triangle], e_.normal[other]) >= kFold;
  }

  const EvenMesh& e_;
  bool is_exact_;
  ShortList<Moved> star_;
  bool keeps_sides_ = true;
};

}  // namespace

bool keeps_sides(const EvenMesh& even, int32_t v, const Vec3& place,
                 std::span<const int32_t> without) {
  return MovedStar(even, v, place, without).is_sound();
}

bool can_be_placed(const EvenMesh& even, int32_t v, const Vec3& place) {
  return MovedStar(even, v, place, {}, true).is_sound();
}

bool is_turned_over(const EvenMesh& even, int32_t triangle) {
  const Plane plane = plane_of(places_of(even, even.mesh.triangle(triangle)));
  return dot(plane.normal, even.normal[triangle]) < 0;
}

bool turns_none(const EvenMesh& even, int32_t from, int32_t to) {
  return MovedStar(even, from, even.position[to], {&to, 1}).keeps_sides();
}

bool can_collapse(const EvenMesh& even, int32_t from, int32_t to) {
  return even.mesh.can_collapse(from, to) &&
         MovedStar(even, from, even.position[to], {&to, 1}).is_sound();
}

void collapse(EvenMesh& even, int32_t from, int32_t to, std::vector<int32_t>& moved) {
  moved.clear();
  even.mesh.for_triangles(from, [&](int32_t t) { moved.push_back(t); });
  even.mesh.collapse(from, to);
  for (const int32_t t : moved) settle_normal(even, t);
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

bool add_triangle(EvenMesh& even, int32_t corner, int32_t a, int32_t b) {
  if (!even.mesh.can_add(corner, a, b)) return false;
  const int32_t beside = even.mesh.triangles_at(corner, a)[0];
  const Triangle& other = even.mesh.triangle(beside);
  const bool runs_back = other[(corner_of(other, corner) + 1) % 3] == a;
  const Triangle triangle = runs_back ? Triangle{a, corner, b} : Triangle{corner, a, b};
  const Plane plane = plane_of(places_of(even, triangle));
  if (plane.height < kNeedle || !(dot(plane.normal, even.normal[beside]) > kMostTurn)) return false;
  even.mesh.add(triangle);
  even.source.push_back(even.source[beside]);
  even.normal.push_back(plane.normal);
  return true;
}

std::vector<int32_t> compact(EvenMesh& even) {
  auto [vertices, triangles, number] = even.mesh.compact();
  even.position = rows_of(even.position, vertices);
  even.target = rows_of(even.target, vertices);
  even.origin = rows_of(even.origin, vertices);
  even.held = rows_of(even.held, vertices);
  even.source = rows_of(even.source, triangles);
  even.normal = rows_of(even.normal, triangles);
  return number;
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
