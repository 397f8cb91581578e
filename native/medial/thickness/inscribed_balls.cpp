// SPDX-License-Identifier: GPL-3.0-or-later
#include "thickness/inscribed_balls.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/parallel.h"
#include "base/rows.h"
#include "base/union_find.h"

namespace medial {
namespace {

constexpr int kMostShrinks = 96;   // next to a convex edge each one halves the ball
constexpr int kMostSettlings = 8;  // on one triangle
constexpr int kMostSteps = 16;     // from triangle to triangle, before all others are searched
constexpr double kInside = 1e-9;   // of the radius: a place so deep is inside; derived: rounding
// Faces whose normals differ by less than 60 degrees from that of a place look almost as it does.
constexpr double kAlike = 0.5;  // derived: -kOpposite
// Curved triangles know the surface up to this share of their bulge, but at vertices: measured on a
// torus of 90,000 slanted triangles, whose balls are off by a twentieth.
constexpr double kUnknown = 1.0 / 16;  // measured: a twentieth on that torus
// The normals of nearly parallel walls differ by 165 degrees or more.
constexpr double kParallel = -0.9659258262890683;  // chosen: unseen
// Places opposite lie no farther than the root of 3/4 from half of the way to the far end of a
// ball, in radii; some more for normals that are not quite those of the ball.
constexpr double kHalfWay = 0.5, kReachOpposite = 0.9;  // derived: sqrt(3 / 4)
constexpr int kMostRolls = 64;                          // steps of a ball that rolls
constexpr double kStill = 1e-9;    // of the radius: a shorter step is none; derived: rounding
constexpr double kMet = 1e-6;      // two balls are one if they are so close; derived: rounding
constexpr int kMostInVain = 48;    // leaves of the tree of faces
constexpr double kSmaller = 0.99;  // a ball searched to the end: few touch it; work: time
constexpr double kNothing = 1e-3;  // roundings: a smaller ball is none; derived: rounding
// In a run, each ball starts where the one before touched, on the wall opposite if there is one: in
// a tube it then needs no search for this wall. Both walls of a shell may be in one run, so the one
// before is of those that look about the same way: as the first place of the run, or against it.
constexpr int64_t kRunOfPlaces = 64;

struct Place {
  Vec3 point, normal;
  Vec3 flat;  // where the place is on the flat triangle
  double spacing = 0;
  double unknown = 0;  // so far it may be off the surface
  double turned = 0;   // so far its normal may be turned, as a sine
  double tilted = 0;   // so far the normal may be off where the surface is curved, in radians
  int32_t sheet = -1;  // of the surface between sharp edges
};

struct InnerBall {
  double radius = HUGE_VAL;
  Foot foot;
};

struct RolledBall {
  InnerBall ball;
  Place at;
};

Vec3 centre_of(const Place& x, double radius) { return x.point - radius * x.normal; }

// Returns the radius of the ball that touches the surface at a place and goes through a point.
double radius_through(const Place& x, const Vec3& q) {
  const Vec3 away = x.point - q;
  const double depth = dot(away, x.normal);
  return depth > 0 ? squared_length(away) / (2 * depth) : HUGE_VAL;
}

// Returns the side of a square twice as large as a triangle.
double width_of(const TriangleMesh& mesh, int32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3& p = mesh.points[a];
  return std::sqrt(length(cross(mesh.points[b] - p, mesh.points[c] - p)));
}

class Shrinking {
 public:
  Shrinking(const Faces& faces, double rounding) : faces_(faces), rounding_(rounding) {
    reach_ = 0.5 * length(box_of(faces.mesh().points).extent());
    UnionFind joined(faces.mesh().triangles.size());
    for (const MeshEdge& edge : faces.creases().edges) {
      const auto [a, b] = edge.triangles;
      if (edge.crease == Crease::none && b >= 0) joined.unite(a, b);
    }
    for (int32_t t = 0; t < std::ssize(faces.mesh().triangles); ++t)
      sheet_.push_back(joined.find(t));
  }

  Place place_of(const FacePlaces& places, int32_t row) const {
    Place x{places.points[row], {}, places.points[row], places.spacing[row]};
    const int32_t t = faces_.triangle_of(places.triangle[row]);
    if (!places.normals.empty()) x.normal = places.normals[row];
    if (t < 0) return x;
    x.turned = turned(t);
    x.sheet = sheet_[t];
    const Foot foot = foot_of(t, x.point);
    const bool at_vertex = foot.at.a == 1 || foot.at.b == 1 || foot.at.c == 1;
    if (!at_vertex) x.unknown = kUnknown * faces_.bulge(t);
    if (faces_.is_curved(t)) x.spacing = std::max(x.spacing, width_of(faces_.mesh(), t));
    if (!places.normals.empty()) return x;
    x.point = foot.point;
    x.normal = faces_.normal(t, foot.at);
    x.tilted = length(x.normal - faces_.normal_of_patch(t, foot.at));
    return x;
  }

  // Returns the place of the smooth surface that a place of a flat triangle is: the nearest one, as
  // the same share of a curved triangle may be farther along it, and so nearer to a rim. Where the
  // nearest one is on the rim itself, the share keeps off it.
  Foot foot_of(int32_t triangle, const Vec3& point) const {
    const Foot nearest = faces_.foot_on(triangle, point);
    return faces_.is_at_end(nearest) ? faces_.lifted(triangle, point) : nearest;
  }

  // Returns the largest ball, which may start from one that touches close by.
  InnerBall ball(const Place& x, const InnerBall& beside) const {
    InnerBall found = start(x, beside);
    shrink(x, found, [&](const Foot& q, const Vec3&) { return is_own(x, q); });
    return found;
  }

  // Returns the ball between walls whose normals have this cosine at most, or an infinite one: the
  // largest ball that holds no place opposite, where it is the largest ball of all, as far as the
  // surface is known. A ball in a tube touches it all round.
  InnerBall between_walls(const Place& x, const InnerBall& ball, double cosine) const {
    if (ball.foot.triangle < 0 || !(ball.radius > kNothing * rounding_)) return {};
    // A face that a ball touches from outside is no wall, as where curved faces go through others.
    const auto is_beside = [&](const Foot& q, const Vec3& centre) {
      const Vec3 normal = normal_at(q, centre);
      const double between = dot(x.normal, normal);
      return (between > cosine && between > cosine + turned(x, q)) ||
             dot(q.point - centre, normal) < 0 || is_moved_through(x, q);
    };
    if (!is_beside(ball.foot, centre_of(x, ball.radius))) return ball;
    const double more = uncertainty(x, ball) + gain(x, ball) * x.unknown;
    const double most = std::min(ball.radius + more, reach_);
    const double beyond = x.unknown + x.tilted * most;
    const Vec3 centre = centre_of(x, most);
    const auto is_apart = [&](const Foot& at) {
      const Foot q = faces_.lifted(at.triangle, centre);
      return q.distance > most + beyond + unknown_of(q) || is_beside(q, centre);
    };
    const auto other = faces_.nearest_lifted({.from = centre - kHalfWay * most * x.normal,
                                              .than = kReachOpposite * most,
                                              .second_centre = centre,
                                              .second_radius = most + beyond + rounding_},
                                             is_apart);
    if (!other) return {};
    InnerBall found = settled(x, faces_.lifted(other->triangle, centre));
    shrink(x, found, is_beside);
    return found.radius - ball.radius <= unknown_between(x, ball, found) ? found : InnerBall{};
  }

  // Returns the ball between walls at which a ball comes to rest that rolls away from what it
  // touches. It is one of the place to which it rolled, or of the foot of that, as in the narrow
  // side of a plate, and infinite where it comes to rest between no walls.
  RolledBall rolled(Place x, int32_t triangle, InnerBall ball) const {
    double step = ball.radius;
    for (int i = 0; i < kMostRolls && step > kStill * ball.radius; ++i) {
      const Vec3 away = x.point - ball.foot.point;
      const Vec3 along = normalized(away - dot(away, x.normal) * x.normal);
      if (along == Vec3{}) return {};
      const Foot foot = faces_.descend(triangle, x.point + step * along);
      const Place next = moved_to(x, foot);
      if (dot(next.normal, x.normal) < kAlike) {  // another side of a reflex edge
        step *= 0.5;
        continue;
      }
      const InnerBall met = this->ball(next, {});
      if (met.foot.triangle < 0) return {};
      // A ball that got smaller rolled too far, as onto a reflex corner.
      const bool is_there = met.radius >= (1 - kMet) * ball.radius;
      const InnerBall wall = is_there ? between_walls(next, met, kOpposite) : InnerBall{};
      if (wall.foot.triangle >= 0) return {wall, next};
      const bool is_larger = met.radius > ball.radius;
      if (are_opposite(x, ball, next, met) && step <= kMet * ball.radius) {
        return is_larger ? at_foot(next, met) : at_foot(x, ball);
      }
      if (!is_larger) step *= 0.5;
      if (!is_larger) continue;
      x = next, triangle = foot.triangle, ball = met;
    }
    return {};
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
    const Vec3 centre = centre_of(x, radius);
    const auto outside = [&](const Foot& q) {
      const double unknown = x.unknown + kUnknown * faces_.bulge(q.triangle);
      return q.distance + unknown > radius || left_out(q, centre);
    };
    return faces_.nearest_lifted({.from = centre,
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

  // Returns how far a foot may be off.
  double unknown_of(const Foot& q) const { return kUnknown * faces_.bulge(q.triangle) + rounding_; }

  // Returns how much a ball grows when its foot moves away: one close to the place makes more of it
  // than one on the far side.
  static double gain(const Place& x, const InnerBall& ball) {
    const double depth = dot(x.point - ball.foot.point, x.normal);
    return depth > 0 ? ball.radius / depth : 0;
  }

  // Returns how much larger a ball may be, by its foot and by the normal at the place, which turns
  // the ball about this.
  double uncertainty(const Place& x, const InnerBall& ball) const {
    const double aside = length(cross(x.point - ball.foot.point, x.normal));
    return gain(x, ball) * (unknown_of(ball.foot) + x.tilted * aside);
  }

  // Returns how far the difference of two balls at a place may be off. If the place moved along its
  // normal, both would change.
  double unknown_between(const Place& x, const InnerBall& a, const InnerBall& b) const {
    return uncertainty(x, a) + uncertainty(x, b) + std::abs(gain(x, a) - gain(x, b)) * x.unknown;
  }

  // Returns how far the cosine between the normals at a place and a foot may be off by rounding; if
  // this makes a right angle of opposite walls, as at slivers, the normals say nothing more.
  double turned(const Place& x, const Foot& q) const {
    const double both = x.turned + turned(q.triangle);
    return both < -kOpposite ? both : 0;
  }
  double turned(int32_t triangle) const {
    const auto& [a, b, c] = faces_.mesh().triangles[triangle];
    const Vec3 &p = faces_.mesh().points[a], &q = faces_.mesh().points[b],
               &r = faces_.mesh().points[c];
    const double longest = std::max({distance(p, q), distance(q, r), distance(r, p)});
    return rounding_ * longest / length(cross(q - p, r - p));  // over the least height
  }

  // Returns the normal where a ball touches a foot. On a reflex edge, where faces have all normals
  // between those of its sides, it is that of the ball, but that of a side if the ball reaches
  // through it to the edge or, under a surface that bulges, touches the edge from outside.
  Vec3 normal_at(const Foot& q, const Vec3& centre) const {
    const std::array<double, 3> opposite{q.at.c, q.at.a, q.at.b};  // of the corner, for each edge
    for (int i = 0; i < 3; ++i) {
      const int32_t edge = faces_.edge_of(q.triangle, i);
      if (opposite[i] != 0 || !faces_.is_reflex_crease(edge)) continue;
      const Foot here{q.triangle, q.at, q.point, distance(q.point, centre)};
      const Foot side = faces_.lifted_beside(here, centre);
      if (side.distance < (1 - kInside) * here.distance)
        return faces_.normal(side.triangle, side.at);
      const Vec3 of_ball = normalized(q.point - centre);
      const auto& [one, other] = faces_.creases().edges[edge].triangles;
      const auto& normals = faces_.mesh().normal;
      if (dot(of_ball, normals[one] + normals[other]) > 0) return of_ball;
    }
    return faces_.normal(q.triangle, q.at);
  }

  // Returns whether the smooth surface at a place lies behind a foot though the flat triangle lies
  // before that of the foot, as where two faces enclose a narrow gap next to a reflex edge: then
  // the place is inside what the smooth surfaces bound.
  bool is_moved_through(const Place& x, const Foot& q) const {
    const TriangleMesh& mesh = faces_.mesh();
    const Vec3 before = x.flat - mesh.points[mesh.triangles[q.triangle][0]];
    return dot(before, mesh.normal[q.triangle]) > rounding_ &&
           dot(x.point - q.point, faces_.normal(q.triangle, q.at)) < 0;
  }

  // Returns whether balls at two places touch walls that are opposite to each other.
  bool are_opposite(const Place& x, const InnerBall& a, const Place& y, const InnerBall& b) const {
    return dot(normal_at(a.foot, centre_of(x, a.radius)),
               normal_at(b.foot, centre_of(y, b.radius))) <= kOpposite;
  }

  // Returns the largest ball that touches the foot of another one and holds no place opposite.
  RolledBall at_foot(const Place& x, const InnerBall& ball) const {
    Place y = moved_to(x, ball.foot);
    y.normal = normal_at(ball.foot, centre_of(x, ball.radius));
    InnerBall found{reach_, {}};
    shrink(y, found, [&](const Foot& q, const Vec3& centre) {
      return dot(y.normal, normal_at(q, centre)) > kOpposite + turned(y, q);
    });
    return {found, y};
  }

  // Returns a place at a foot.
  Place moved_to(const Place& x, const Foot& foot) const {
    Place y = x;
    y.point = foot.point;
    const auto& [a, b, c] = faces_.mesh().triangles[foot.triangle];
    const auto& points = faces_.mesh().points;
    y.flat = foot.at.a * points[a] + foot.at.b * points[b] + foot.at.c * points[c];
    y.normal = faces_.normal(foot.triangle, foot.at);
    y.unknown = kUnknown * faces_.bulge(foot.triangle);
    y.turned = turned(foot.triangle);
    y.tilted = length(y.normal - faces_.normal_of_patch(foot.triangle, foot.at));
    y.sheet = sheet_[foot.triangle];
    return y;
  }

  // Returns whether a foot belongs to the surface round a place, on its side of sharp edges: a ball
  // that touches this at the place, up to rounding and to how well triangles know its curvature,
  // does not hold the foot.
  bool is_own(const Place& x, const Foot& q) const {
    const Vec3 away = x.point - q.point;
    const double depth = dot(away, x.normal);
    if (!(depth > 0)) return true;
    const bool is_near = squared_length(away) < x.spacing * x.spacing;
    if (depth > rounding_ && !(is_near && sheet_[q.triangle] == x.sheet)) return false;
    return dot(faces_.normal(q.triangle, q.at), x.normal) > kAlike;
  }

  const Faces& faces_;
  double reach_ = 0;
  double rounding_ = 0;
  std::vector<int32_t> sheet_;  // per triangle
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

}  // namespace

InscribedBalls inscribed_balls(const Faces& faces, const FacePlaces& places, const Run& run) {
  const size_t count = places.points.size();
  const std::vector<double> none(count, HUGE_VAL);
  InscribedBalls result{none, none, none};
  const Shrinking shrinking(faces, places.rounding);
  const auto order = order_of(faces, places.triangle);
  const auto measure = [&](const Place& x, int32_t i, InnerBall& last) {
    last = shrinking.ball(x, last);
    if (last.foot.triangle < 0) return;
    result.diameter[i] = 2 * last.radius;
    const InnerBall wall = shrinking.between_walls(x, last, kOpposite);
    result.wall[i] = 2 * wall.radius;
    if (wall.foot.triangle < 0) return;
    result.parallel[i] = 2 * shrinking.between_walls(x, wall, kParallel).radius;
    last = wall;
  };
  parallel_chunks(
      static_cast<int64_t>(count), run,
      [&](int64_t begin, int64_t end, int) {
        Vec3 first;
        std::array<InnerBall, 2> last;
        for (int64_t i = begin; i < end; ++i) {
          const Place x = shrinking.place_of(places, order[i]);
          if (x.normal == Vec3{}) continue;
          if (first == Vec3{}) first = x.normal;
          measure(x, order[i], last[dot(first, x.normal) < 0 ? 1 : 0]);
        }
      },
      kRunOfPlaces);
  return result;
}

InscribedBalls rolled_balls(const Faces& faces, const FacePlaces& places, const Run& run) {
  const std::vector<double> none(places.points.size(), HUGE_VAL);
  InscribedBalls result{none, none, none};
  const Shrinking shrinking(faces, places.rounding);
  parallel_for(static_cast<int64_t>(none.size()), run, [&](int64_t i) {
    const auto row = static_cast<int32_t>(i);
    const int32_t triangle = faces.triangle_of(places.triangle[i]);
    const Place x = shrinking.place_of(places, row);
    if (triangle < 0 || x.normal == Vec3{}) return;
    const InnerBall ball = shrinking.ball(x, {});
    if (ball.foot.triangle < 0) return;
    const RolledBall rest = shrinking.rolled(x, triangle, ball);
    result.diameter[i] = result.wall[i] = 2 * rest.ball.radius;
    if (rest.ball.foot.triangle < 0) return;
    result.parallel[i] = 2 * shrinking.between_walls(rest.at, rest.ball, kParallel).radius;
  });
  return result;
}

}  // namespace medial
