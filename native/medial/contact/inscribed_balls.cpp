// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/inscribed_balls.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "base/parallel.h"

namespace medial {
namespace {

constexpr int kMostShrinks = 96;   // next to a convex edge each one halves the ball
constexpr int kMostSettlings = 8;  // on one triangle
constexpr int kMostSteps = 16;     // from triangle to triangle, before all others are searched
constexpr double kInside = 1e-9;   // a place is inside if it is so deep, as a share of the radius
// Faces whose normals differ by less than 60 degrees from that of a place look almost as it does.
constexpr double kAlike = 0.5;
// Coordinates may have been float32.
constexpr double kCoordinate = 4.0 * std::numeric_limits<float>::epsilon();
// Curved triangles know the surface up to this share of their bulge next to vertices, and up to the
// other one between those.
constexpr double kUnknown = 1.0 / 64, kUnknownBetween = 1.0 / 4;
// A ball lies between walls if one of the places that it touches, up to so much of its radius, is
// opposite: the normal there differs from that of the first place by 120 degrees or more.
constexpr double kTouched = 0.03, kOpposite = -0.5;
// There the normal of the faces leads away from the centre, up to 25 degrees.
constexpr double kTangent = 0.9;
// It is looked for from half of the way to the place opposite, up to so far from there, in radii.
constexpr double kHalfWay = 0.5, kReachOpposite = 0.9;
constexpr int kMostInVain = 48;    // leaves of the tree of faces
constexpr double kSmaller = 0.99;  // a ball that is searched to the end, which few faces touch
constexpr double kNothing = 1e-3;  // a ball of so many roundings is none
// In a run, each ball starts where the one before touched, on the wall opposite if there is one: in
// a tube it then needs no search for this wall. Both walls of a shell may be in one run, so the one
// before is of those that look about the same way: as the first place of the run, or against it.
constexpr int64_t kRunOfPlaces = 64;

struct Place {
  Vec3 point, normal;
  double spacing = 0;
  double unknown = 0;  // so far it may be off the surface
};

struct InnerBall {
  double radius = HUGE_VAL;
  Foot foot;
};

Vec3 centre_of(const Place& x, double radius) { return x.point - radius * x.normal; }

// Returns the radius of the ball that touches the surface at a place and goes through a point.
double radius_through(const Place& x, const Vec3& q) {
  const Vec3 away = x.point - q;
  const double depth = dot(away, x.normal);
  return depth > 0 ? squared_length(away) / (2 * depth) : HUGE_VAL;
}

class Shrinking {
 public:
  explicit Shrinking(const Faces& faces) : faces_(faces) {
    Box box;
    double largest = 0;
    for (const Vec3& p : faces.mesh().points) {
      box.add(p);
      largest = std::max(largest, max_abs(p));
    }
    reach_ = 0.5 * length(box.extent());
    rounding_ = kCoordinate * largest;
  }

  // Returns the largest ball, which may start from one that touches close by.
  InnerBall ball(const Place& x, const InnerBall& beside) const {
    InnerBall found = start(x, beside);
    shrink(x, found, [&](const Foot& q) { return is_own(x, q); });
    return found;
  }

  // Returns the ball between walls, or an infinite one if it lies between none: a ball that touches
  // a place opposite. A ball in a tube touches it all round, and any of these places may be the one
  // that was found.
  InnerBall between_walls(const Place& x, const InnerBall& ball) const {
    if (!(ball.radius > kNothing * rounding_)) return {};
    const Vec3 centre = centre_of(x, ball.radius);
    const auto is_opposite = [&](const Foot& q) {
      const double away = distance(q.point, centre);
      return away <= (1 + kTouched) * ball.radius &&
             dot(x.normal, q.point - centre) <= kOpposite * away && is_tangent(q, centre);
    };
    if (is_opposite(ball.foot)) return ball;
    const auto beside = [&](const Foot& q) {
      return !is_opposite(faces_.lifted(q.triangle, centre));
    };
    const auto other = faces_.nearest_lifted({.from = centre - kHalfWay * ball.radius * x.normal,
                                              .than = kReachOpposite * ball.radius,
                                              .second_centre = centre,
                                              .second_radius = (1 + kTouched) * ball.radius},
                                             beside);
    if (!other) return {};
    InnerBall found = settled(x, faces_.lifted(other->triangle, centre));
    const auto is_beside = [&](const Foot& q) {
      return dot(x.normal, q.point - centre) > kOpposite * distance(q.point, centre);
    };
    shrink(x, found, is_beside);
    return found;
  }

 private:
  // Shrinks a ball until it holds no place, except those that `left_out` is true of.
  template <typename LeftOut>
  void shrink(const Place& x, InnerBall& found, const LeftOut& left_out) const {
    for (int i = 0; i < kMostShrinks && found.radius > kNothing * rounding_; ++i) {
      const auto inside = inside_of(x, found.radius, left_out);
      if (!inside) break;
      found = settled(x, *inside);
    }
  }

  // Returns a place in a ball.
  template <typename LeftOut>
  std::optional<Foot> inside_of(const Place& x, double radius, const LeftOut& left_out) const {
    const auto outside = [&](const Foot& q) {
      const double unknown = x.unknown + kUnknown * faces_.bulge(q.triangle);
      return q.distance + unknown > radius || left_out(q);
    };
    return faces_.nearest_lifted({.from = centre_of(x, radius),
                                  .than = (1 - kInside) * radius,
                                  .most_in_vain = kMostInVain,
                                  .smaller = kSmaller * radius},
                                 outside);
  }

  // A ball that goes through a place of the faces is never smaller than the one that is wanted.
  InnerBall start(const Place& x, const InnerBall& beside) const {
    InnerBall found{reach_, {}};
    if (beside.foot.triangle < 0) return found;
    const Foot foot = faces_.lifted(beside.foot.triangle, centre_of(x, beside.radius));
    if (is_own(x, foot)) return found;
    const InnerBall walked = walk(x, settled(x, foot));
    return walked.radius < reach_ ? walked : found;
  }

  // Shrinks a ball along the wall that it touches.
  InnerBall walk(const Place& x, InnerBall found) const {
    for (int i = 0; i < kMostSteps; ++i) {
      const Vec3 centre = centre_of(x, found.radius);
      const Foot next = faces_.lifted_beside(found.foot, centre);
      if (!(next.distance < (1 - kInside) * found.radius) || is_own(x, next)) break;
      found = settled(x, next);
    }
    return found;
  }

  // Returns the ball that touches the triangle of a foot, which lies in a larger ball.
  InnerBall settled(const Place& x, const Foot& inside) const {
    InnerBall found{radius_through(x, inside.point), inside};
    for (int i = 0; i < kMostSettlings; ++i) {
      const Foot next = faces_.lifted(inside.triangle, centre_of(x, found.radius));
      const double radius = radius_through(x, next.point);
      if (is_own(x, next) || !(radius < (1 - kInside) * found.radius)) break;
      found = {radius, next};
    }
    return found;
  }

  // Returns whether a ball that reaches a foot touches the faces there. One that sticks out of a
  // flat face, as far as the surface is unknown, reaches places beside the one that it touches.
  bool is_tangent(const Foot& q, const Vec3& centre) const {
    const Vec3 away = q.point - centre;
    if (dot(faces_.normal(q.triangle, q.at), away) >= kTangent * length(away)) return true;
    const std::array<double, 3> opposite{q.at.c, q.at.a, q.at.b};  // of the corner, for each edge
    for (int i = 0; i < 3; ++i) {
      if (opposite[i] == 0 && faces_.is_reflex_crease(faces_.edge_of(q.triangle, i))) return true;
    }
    return false;
  }

  // Returns whether a foot belongs to the surface round a place: a ball that touches this at the
  // place, up to rounding and to how well triangles know its curvature, does not hold the foot.
  bool is_own(const Place& x, const Foot& q) const {
    const Vec3 away = x.point - q.point;
    const double depth = dot(away, x.normal);
    if (!(depth > 0)) return true;
    if (depth > rounding_ && squared_length(away) >= x.spacing * x.spacing) return false;
    return dot(faces_.normal(q.triangle, q.at), x.normal) > kAlike;
  }

  const Faces& faces_;
  double reach_ = 0;
  double rounding_ = 0;
};

// Places whose triangles are close to each other in the tree follow each other.
std::vector<int32_t> order_of(const Faces& faces, std::span<const int32_t> triangle) {
  const auto place_of = faces.places_in_tree();
  std::vector<std::pair<int32_t, int32_t>> keys;
  keys.reserve(triangle.size());
  for (size_t i = 0; i < triangle.size(); ++i) {
    const int32_t t = faces.triangle_of(triangle[i]);
    keys.emplace_back(t < 0 ? -1 : place_of[t], static_cast<int32_t>(i));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int32_t> order;
  order.reserve(keys.size());
  for (const auto& [key, i] : keys) order.push_back(i);
  return order;
}

// Returns the side of a square twice as large as a triangle.
double width_of(const TriangleMesh& mesh, int32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3& p = mesh.points[a];
  return std::sqrt(length(cross(mesh.points[b] - p, mesh.points[c] - p)));
}

Place place_of(const Faces& faces, const FacePlaces& places, int32_t row) {
  Place x{places.points[row], {}, places.spacing[row]};
  const int32_t t = faces.triangle_of(places.triangle[row]);
  if (!places.normals.empty()) x.normal = places.normals[row];
  if (t < 0) return x;
  const Foot foot = faces.lifted(t, x.point);
  const bool at_vertex = foot.at.a == 1 || foot.at.b == 1 || foot.at.c == 1;
  if (!at_vertex) x.unknown = kUnknownBetween * faces.bulge(t);
  if (faces.is_curved(t)) x.spacing = std::max(x.spacing, width_of(faces.mesh(), t));
  if (!places.normals.empty()) return x;
  x.point = foot.point;
  x.normal = faces.normal(t, foot.at);
  return x;
}

}  // namespace

InscribedBalls inscribed_balls(const Faces& faces, const FacePlaces& places, const Run& run) {
  const size_t count = places.points.size();
  InscribedBalls result{std::vector<double>(count, HUGE_VAL), std::vector<double>(count, HUGE_VAL)};
  const Shrinking shrinking(faces);
  const auto order = order_of(faces, places.triangle);
  const auto measure = [&](const Place& x, int32_t i, InnerBall& last) {
    last = shrinking.ball(x, last);
    if (last.foot.triangle < 0) return;
    result.diameter[i] = 2 * last.radius;
    const InnerBall wall = shrinking.between_walls(x, last);
    result.wall[i] = 2 * wall.radius;
    if (wall.foot.triangle >= 0) last = wall;
  };
  parallel_chunks(
      static_cast<int64_t>(count), run,
      [&](int64_t begin, int64_t end, int) {
        Vec3 first;
        std::array<InnerBall, 2> last;
        for (int64_t i = begin; i < end; ++i) {
          const Place x = place_of(faces, places, order[i]);
          if (x.normal == Vec3{}) continue;
          if (first == Vec3{}) first = x.normal;
          measure(x, order[i], last[dot(first, x.normal) < 0 ? 1 : 0]);
        }
      },
      kRunOfPlaces);
  return result;
}

}  // namespace medial
