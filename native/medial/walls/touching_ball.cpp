// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/touching_ball.h"

#include "walls/followed_ball.h"

namespace medial {
namespace {

constexpr int kBallSteps = 16;
constexpr int kPatience = 4;         // steps after which each has to halve the inequality
constexpr double kRounding = 2e-14;  // of the radius; derived: 100 roundings of 2e-16

struct Feet {
  std::array<Foot, kMostContacts> foot;
  std::array<Vec3, kMostContacts> away;  // the gradient of the distance: unit, from the wall
  size_t count = 0;
};

void set_foot(Feet& feet, size_t i, const Foot& foot, const Vec3& centre) {
  feet.foot[i] = foot;
  feet.away[i] = normalized(centre - foot.point);
}

Feet feet_of(const Faces& faces, std::span<const int32_t> walls, const Vec3& centre) {
  Feet feet;
  feet.count = walls.size();
  for (size_t i = 0; i < walls.size(); ++i) {
    set_foot(feet, i, faces.descend(walls[i], centre), centre);
  }
  return feet;
}

void move_feet(const Faces& faces, const Vec3& centre, Feet& feet) {
  for (size_t i = 0; i < feet.count; ++i) {
    set_foot(feet, i, faces.descend_again(feet.foot[i], centre), centre);
  }
}

// Returns the shortest step that makes all distances equal to that of the first wall, to first
// order: a row of the system for each other wall, made orthogonal with the longest row first.
Vec3 step_of(const Feet& feet) {
  std::array<Vec3, kMostContacts> row;
  std::array<double, kMostContacts> wanted{};
  for (size_t i = 1; i < feet.count; ++i) {
    row[i] = feet.away[i] - feet.away[0];
    wanted[i] = feet.foot[0].distance - feet.foot[i].distance;
  }
  Vec3 step;
  for (size_t round = 1; round < feet.count; ++round) {
    size_t longest = round;
    for (size_t i = round + 1; i < feet.count; ++i) {
      if (squared_length(row[i]) > squared_length(row[longest])) longest = i;
    }
    std::swap(row[round], row[longest]);
    std::swap(wanted[round], wanted[longest]);
    const double size = length(row[round]);
    if (size < kSameFoot) break;
    const Vec3 unit = (1 / size) * row[round];
    const double along = wanted[round] / size;
    step = step + along * unit;
    for (size_t i = round + 1; i < feet.count; ++i) {
      const double share = dot(row[i], unit);
      row[i] = row[i] - share * unit;
      wanted[i] -= share * along;
    }
  }
  return step;
}

double inequality(const Feet& feet) {
  double low = HUGE_VAL, high = 0;
  for (size_t i = 0; i < feet.count; ++i) {
    low = std::min(low, feet.foot[i].distance);
    high = std::max(high, feet.foot[i].distance);
  }
  return high - low;
}

}  // namespace

TouchingBall touching_ball(const Faces& faces, std::span<int32_t> walls, const Vec3& start) {
  if (const auto followed = followed_ball(faces, walls, start)) return *followed;
  Vec3 centre = start;
  Feet feet = feet_of(faces, walls, centre);
  double before = HUGE_VAL;
  for (int i = 0; i < kBallSteps; ++i) {
    const Vec3 step = step_of(feet);
    if (!(length(step) > kRounding * feet.foot[0].distance)) break;
    centre = centre + step;
    move_feet(faces, centre, feet);
    const double unequal = inequality(feet);
    if (unequal <= kRounding * feet.foot[0].distance) break;
    if (i >= kPatience && unequal > 0.5 * before) break;  // no ball touches all of the walls
    before = unequal;
  }
  for (size_t i = 0; i < walls.size(); ++i) walls[i] = feet.foot[i].triangle;
  double least = HUGE_VAL;
  for (size_t i = 0; i < feet.count; ++i) least = std::min(least, feet.foot[i].distance);
  return {centre, least, inequality(feet), feet.away};
}

}  // namespace medial
