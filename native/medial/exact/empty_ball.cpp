// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/empty_ball.h"

#include <numbers>

#include "base/portable_math.h"
#include "walls/followed_ball.h"

namespace medial {
namespace {

// Lengths are in holes between the samples.
constexpr double kExact = 1e-10;       // between a radius and the distance; derived: rounding
constexpr double kFarthestMove = 2;    // that a vertex moves to touch walls; chosen: axis
constexpr int kMoreWalls = 8;          // attempts to mend walls that the ball sticks out of
constexpr double kNearlyEqual = 1e-3;  // distances to walls of one rough ball; chosen: unseen
constexpr double kBefore = 0.5;        // the cosine between a wire and its wall; chosen: unseen

// Returns whether a wall is seen from its inner side. All of them are, except the walls of a sharp
// reflex edge, which a ball rolls round.
bool is_inside(const Faces& faces, const Walls& walls,
               const std::array<Vec3, kMostContacts>& away) {
  for (size_t i = 0; i < walls.count; ++i) {
    if (dot(away[i], faces.mesh().normal[walls.triangle[i]]) < 0) return true;
  }
  return false;
}

class BallFinder {
 public:
  BallFinder(const SamplesOnFaces& samples, const NearPlace& near)
      : samples_(samples), near_(near), tolerance_(kExact * near.hole) {}

  // A wall that the ball sticks out of is added. If there are as many as it may touch, or if it is
  // seen in the direction of a wall already there, that one's foot was not the nearest.
  Touch find(Walls walls, Vec3 start, size_t most, bool swaps) const {
    for (int i = 0; i < kMoreWalls; ++i) {
      const Trial trial = tried(walls, start);
      if (!trial.is_ball) return {};
      if (!trial.nearer) return found(trial);
      if (!samples_.are_near(trial.nearer->point)) return {};
      start = trial.ball.centre;
      walls = trial.walls;
      const auto [wall, apart] = likeliest(trial);
      if (apart <= kSameFoot || (swaps && walls.count >= most)) {
        walls.triangle[wall] = trial.nearer->triangle;
      } else if (walls.count >= most || !walls.add(trial.nearer->triangle)) {
        return {};
      }
    }
    return {};
  }

 private:
  struct Trial {
    TouchingBall ball;
    Walls walls;
    bool is_ball = false;        // whether it touches all walls, in two places at least
    std::optional<Foot> nearer;  // a place of the faces inside the ball
  };

  Trial tried(Walls walls, const Vec3& start) const {
    Trial trial{touching_ball(samples_.faces(), walls.all(), start), walls, false, {}};
    trial.walls = walls;
    const TouchingBall& ball = trial.ball;
    trial.is_ball = ball.unequal <= tolerance_ &&
                    distance(ball.centre, near_.place) <= kFarthestMove * near_.hole &&
                    touches_twice(ball, walls.count);
    if (trial.is_ball) {
      trial.nearer = samples_.faces().nearer(ball.centre, ball.radius - tolerance_);
    }
    return trial;
  }

  // Returns the wall whose foot is seen nearest to the direction of a place inside the ball, and
  // how far apart the two directions are.
  static std::pair<size_t, double> likeliest(const Trial& trial) {
    const Vec3 away = normalized(trial.ball.centre - trial.nearer->point);
    std::pair<size_t, double> best{0, HUGE_VAL};
    for (size_t i = 0; i < trial.walls.count; ++i) {
      const double apart = distance(trial.ball.away[i], away);
      if (apart < best.second) best = {i, apart};
    }
    return best;
  }

  // There are samples near all feet: a ball may have rolled to a face inside the solid, which
  // bounds nothing. And it is inside: where samples are far apart, it may have gone past an edge.
  Touch found(const Trial& trial) const {
    const TouchingBall& ball = trial.ball;
    if (!is_inside(samples_.faces(), trial.walls, ball.away)) return {};
    for (size_t i = 0; i < trial.walls.count; ++i) {
      if (!samples_.are_near(ball.centre - ball.radius * ball.away[i])) return {};
    }
    return {ball.centre, ball.radius, trial.walls, ball.away};
  }

  // Returns whether the feet are not all in one place, as they are beyond the rim of a sheet.
  static bool touches_twice(const TouchingBall& ball, size_t walls) {
    for (size_t i = 1; i < walls; ++i) {
      if (distance(ball.away[i], ball.away[0]) > kSameFoot) return true;
    }
    return false;
  }

  const SamplesOnFaces& samples_;
  const NearPlace& near_;
  double tolerance_;
};

// Returns the wall of a ball that lies before the end of a wire, or -1.
int32_t wall_before(const Touch& at, const Vec3& along) {
  int32_t best = -1;
  double most = kBefore;
  for (size_t i = 0; i < at.walls.count; ++i) {
    if (!(dot(at.away[i], along) > most)) continue;
    most = dot(at.away[i], along);
    best = at.walls.triangle[i];
  }
  return best;
}

// Finds a ball that touches some walls, although others are as near but for what smooth faces are
// off: walls all round the end of a wire. The radius is the distance to the nearest face. The place
// is nearer than a distance to the given one.
Touch nearly_empty_ball(const SamplesOnFaces& samples, double hole, Walls walls, const Vec3& start,
                        double within) {
  const Faces& faces = samples.faces();
  const double room = kNearlyEqual * hole;
  const TouchingBall ball = touching_ball(faces, walls.all(), start);
  if (!(ball.unequal < room) || !(distance(ball.centre, start) < within)) return {};
  const auto nearest = faces.nearer(ball.centre, ball.radius + room);
  const bool touches = nearest && nearest->distance > ball.radius - room;
  if (!touches || !samples.are_near(nearest->point)) return {};
  return {ball.centre, nearest->distance, walls, ball.away};
}

}  // namespace

Touch empty_ball(const SamplesOnFaces& samples, const NearPlace& near, const Walls& walls,
                 const Vec3& start, size_t most, bool swaps) {
  return BallFinder(samples, near).find(walls, start, most, swaps);
}

Touch smooth_ball(const SamplesOnFaces& samples, const NearPlace& near, Walls walls) {
  const auto ball = followed_ball(samples.faces(), walls.all(), near.place);
  if (!ball || !(ball->unequal <= kExact * near.hole)) return {};
  if (!(distance(ball->centre, near.place) <= kFarthestMove * near.hole)) return {};
  if (!is_inside(samples.faces(), walls, ball->away)) return {};
  return {ball->centre, ball->radius, walls, ball->away};
}

bool is_empty_between(const SamplesOnFaces& samples, const Touch& ball, double hole) {
  const Vec3 outward = -normalized(ball.away[0] + ball.away[1]);
  const Vec3 middle = ball.position + ball.radius * outward;
  const Foot there = samples.faces().descend(ball.walls.triangle[0], middle);
  const Foot nearest = samples.faces().descend(there.triangle, ball.position);
  return nearest.distance > ball.radius - kExact * hole;
}

bool is_empty(const SamplesOnFaces& samples, const Touch& ball, double hole) {
  return !samples.faces().nearer(ball.position, ball.radius - kExact * hole);
}

Touch wire_end(const SamplesOnFaces& samples, double hole, const Touch& at, const Vec3& along) {
  Walls walls;
  const int32_t before = wall_before(at, along);
  if (before < 0) return {};
  walls.add(before);
  const auto [right, up] = across(along);
  for (int i = 0; i < 3; ++i) {
    const auto [sine, cosine] = portable::sine_cosine(i * 2 * std::numbers::pi / 3);
    const Vec3 out = cosine * right + sine * up;
    const int32_t t = samples.triangle_near(at.position + at.radius * out);
    if (t < 0 || !samples.faces().is_curved(t)) return {};
    walls.add(t);
  }
  // The end of a wire moves by a hole at most.
  return nearly_empty_ball(samples, hole, walls, at.position, hole);
}

}  // namespace medial
