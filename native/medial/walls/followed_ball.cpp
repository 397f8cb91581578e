// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/followed_ball.h"

namespace medial {
namespace {

constexpr int kSteps = 12;           // of a centre
constexpr int kHops = 6;             // from a triangle to the next one for one step
constexpr double kSmallStep = 1e-4;  // of barycentric coordinates; derived: its cube is the error

// The place of a smooth wall that is nearest to a moving point.
class FollowedFoot {
 public:
  FollowedFoot(const Faces& faces, int32_t triangle, const Vec3& from)
      : faces_(faces), triangle_(triangle), of_(faces.patch(triangle).polynomial({})) {
    const Foot foot = faces.lifted(triangle, from);
    b_ = foot.at.b;
    c_ = foot.at.c;
  }

  int32_t triangle() const { return triangle_; }
  double distance() const { return distance_; }
  const Vec3& away() const { return away_; }
  bool is_settled() const { return step_ < kSmallStep; }

  // Goes to where the foot of a point is to second order. Returns false where the wall ends.
  bool follow(const Vec3& from) {
    for (int hop = 0; hop < kHops; ++hop) {
      if (!step(from)) break;
      const double a = 1 - b_ - c_;
      if (a >= 0 && b_ >= 0 && c_ >= 0) return true;
      const int side = a < std::min(b_, c_) ? 0 : b_ < c_ ? 1 : 2;
      if (!cross(side)) return false;
    }
    return descend(from);
  }

 private:
  // Goes a step of Newton's method. The distance is that at its end, by the same expansion.
  bool step(const Vec3& from) {
    const PatchExpansion s = of_.expansion(b_, c_);
    const Vec3 off = s.point - from;
    const double gb = dot(off, s.b), gc = dot(off, s.c);
    const double bb = squared_length(s.b) + dot(off, s.bb), bc = dot(s.b, s.c) + dot(off, s.bc),
                 cc = squared_length(s.c) + dot(off, s.cc);
    const double determinant = bb * cc - bc * bc;
    if (!(determinant > 0 && bb + cc > 0)) return false;
    const double db = (bc * gc - cc * gb) / determinant, dc = (bc * gb - bb * gc) / determinant;
    step_ = std::abs(db) + std::abs(dc);
    if (!(step_ < 1)) return false;
    const Vec3 foot =
        off + db * s.b + dc * s.c + 0.5 * (db * db * s.bb + 2 * db * dc * s.bc + dc * dc * s.cc);
    distance_ = length(foot);
    away_ = (-1 / distance_) * foot;
    b_ += db;
    c_ += dc;
    return true;
  }

  // Goes to the triangle across a side; returns whether the wall goes on there.
  bool cross(int side) {
    const int32_t edge = faces_.edge_of(triangle_, (side + 1) % 3);
    if (faces_.separates(edge)) return false;
    const auto& both = faces_.creases().edges[edge].triangles;
    const int32_t next = both[both[0] == triangle_];
    std::array<double, 3> at{std::max(1 - b_ - c_, 0.0), std::max(b_, 0.0), std::max(c_, 0.0)};
    at[side] = 0;
    const double sum = at[0] + at[1] + at[2];
    const Triangle &here = faces_.mesh().triangles[triangle_],
                   &there = faces_.mesh().triangles[next];
    const int one = (side + 1) % 3, other = (side + 2) % 3;
    std::array<double, 3> beyond{};
    beyond[corner_of(there, here[one])] = at[one] / sum;
    beyond[corner_of(there, here[other])] = at[other] / sum;
    b_ = beyond[1];
    c_ = beyond[2];
    triangle_ = next;
    of_ = faces_.patch(next).polynomial({});
    return true;
  }

  // Finds the foot where steps lead to and fro over an edge at which the wall is bent.
  bool descend(const Vec3& from) {
    const Foot foot = faces_.descend(triangle_, from);
    if (faces_.is_at_end(foot)) return false;
    if (foot.triangle != triangle_) of_ = faces_.patch(foot.triangle).polynomial({});
    triangle_ = foot.triangle;
    b_ = foot.at.b;
    c_ = foot.at.c;
    distance_ = foot.distance;
    away_ = normalized(from - foot.point);
    step_ = 0;
    return true;
  }

  const Faces& faces_;
  int32_t triangle_;
  PatchPolynomial of_;
  double b_ = 0, c_ = 0, step_ = 0, distance_ = 0;
  Vec3 away_;
};

}  // namespace

std::optional<TouchingBall> followed_ball(const Faces& faces, std::span<int32_t> walls,
                                          const Vec3& start) {
  if (walls.size() != 2 || !faces.is_curved(walls[0]) || !faces.is_curved(walls[1])) return {};
  Vec3 centre = start;
  FollowedFoot one(faces, walls[0], centre), other(faces, walls[1], centre);
  for (int i = 0; i < kSteps; ++i) {
    if (!one.follow(centre) || !other.follow(centre)) return {};
    const double radius = std::min(one.distance(), other.distance());
    const double unequal = std::abs(one.distance() - other.distance());
    if (one.is_settled() && other.is_settled() && unequal <= kRoundingShare * radius) {
      walls[0] = one.triangle();
      walls[1] = other.triangle();
      return TouchingBall{centre, radius, unequal, {one.away(), other.away()}};
    }
    const Vec3 apart = other.away() - one.away();
    const double squared = squared_length(apart);
    if (!(squared > kSameFoot * kSameFoot)) return {};
    centre = centre + ((one.distance() - other.distance()) / squared) * apart;
  }
  return {};
}

}  // namespace medial
