// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/closest_place.h"

namespace medial {
namespace {

constexpr int kPatchSteps = 24;
// In barycentric coordinates: a step this short leaves an error of about its square, which is
// squared again in the distance.
constexpr double kLastStep = 1e-5;  // derived: rounding^(1/4), squared twice
constexpr double kNoStep = 1e-9;    // derived: rounding
constexpr int kMostHalvings = 8;

struct Parameters {
  double b = 0, c = 0;
};

// The value and the derivatives of half the squared distance.
struct Expansion {
  double value = 0, b = 0, c = 0, bb = 0, bc = 0, cc = 0;
};

Expansion expand(const PatchExpansion& s) {
  return {0.5 * squared_length(s.point),
          dot(s.point, s.b),
          dot(s.point, s.c),
          squared_length(s.b) + dot(s.point, s.bb),
          dot(s.b, s.c) + dot(s.point, s.bc),
          squared_length(s.c) + dot(s.point, s.cc)};
}

// The directions along the sides of the triangle of parameters, where a, b or c is 0.
constexpr Parameters kAlong[3] = {{-1, 1}, {0, 1}, {1, 0}};

// Holds which of the coordinates a, b and c are 0.
using OnSides = std::array<bool, 3>;

double coordinate(const Parameters& at, int side) {
  return side == 0 ? 1 - at.b - at.c : side == 1 ? at.b : at.c;
}
double change(const Parameters& step, int side) {
  return side == 0 ? -step.b - step.c : side == 1 ? step.b : step.c;
}

Parameters descent_along(const Parameters& direction, const Expansion& e) {
  const double slope = e.b * direction.b + e.c * direction.c;
  const double bend = e.bb * direction.b * direction.b + 2 * e.bc * direction.b * direction.c +
                      e.cc * direction.c * direction.c;
  const double length = bend > 0 ? -slope / bend : slope > 0 ? -0.5 : slope < 0 ? 0.5 : 0;
  return {length * direction.b, length * direction.c};
}

Parameters newton_step(const Expansion& e) {
  const double determinant = e.bb * e.cc - e.bc * e.bc;
  if (determinant > 0 && e.bb + e.cc > 0) {
    return {(e.bc * e.c - e.cc * e.b) / determinant, (e.bc * e.b - e.bb * e.c) / determinant};
  }
  return descent_along({-e.b, -e.c}, e);
}

// Returns a step that does not lead across the sides on which the place is.
Parameters allowed_step(const Expansion& e, const OnSides& on) {
  const Parameters step = newton_step(e);
  bool leaves = false;
  for (int side = 0; side < 3; ++side) leaves |= on[side] && change(step, side) < 0;
  if (!leaves) return step;
  Parameters best;
  double gain = 0;
  for (int side = 0; side < 3; ++side) {
    if (!on[side]) continue;
    const Parameters along = descent_along(kAlong[side], e);
    bool stays = true;
    for (int other = 0; other < 3; ++other) {
      stays &= other == side || !on[other] || change(along, other) >= 0;
    }
    const double here = -(e.b * along.b + e.c * along.c);
    if (stays && here > gain) {
      gain = here;
      best = along;
    }
  }
  return best;
}

// Returns the share of a step that stays inside the triangle, and the side that ends it, or -1.
std::pair<double, int> room(const Parameters& at, const Parameters& step, const OnSides& on) {
  double share = 1;
  int stop = -1;
  for (int side = 0; side < 3; ++side) {
    const double falls = -change(step, side);
    if (on[side] || !(falls > 0)) continue;
    const double reach = coordinate(at, side) / falls;
    if (reach < share) {
      share = std::max(reach, 0.0);
      stop = side;
    }
  }
  return {share, stop};
}

class Walk {
 public:
  Walk(const Patch& patch, const Barycentric& start, const Vec3& x)
      : patch_(patch.polynomial(x)),
        at_{start.b, start.c},
        on_{start.a <= 0, start.b <= 0, start.c <= 0} {
    settle();
    here_ = expansion(at_);
  }

  Barycentric walk() {
    for (int i = 0; i < kPatchSteps && step(); ++i) {
    }
    return {on_[0] ? 0 : 1 - at_.b - at_.c, at_.b, at_.c};
  }

 private:
  Expansion expansion(const Parameters& at) const { return expand(patch_.expansion(at.b, at.c)); }

  // Puts the place exactly on the sides that it is on.
  void settle() {
    if (on_[1]) at_.b = 0;
    if (on_[2]) at_.c = 0;
    if (on_[0] && on_[1]) at_.c = 1;
    if (on_[0] && on_[2]) at_.b = 1;
    if (on_[0] && !on_[1] && !on_[2]) at_.c = 1 - at_.b;
  }

  // Goes a step, which ends on the side `stop`, or on none if that is -1.
  void go(const Parameters& step, int stop) {
    at_ = {at_.b + step.b, at_.c + step.c};
    for (int side = 0; side < 3; ++side) {
      on_[side] = (on_[side] && !(change(step, side) > 0)) || side == stop;
    }
    settle();
  }

  bool step() {
    const Parameters step = allowed_step(here_, on_);
    const double length = std::abs(step.b) + std::abs(step.c);
    if (length < kNoStep) return false;
    const auto [share, stop] = room(at_, step, on_);
    if (length < kLastStep && stop < 0) {
      go(step, -1);
      return false;
    }
    const OnSides before_on = on_;
    const Parameters before = at_;
    double scale = share;
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings, scale *= 0.5) {
      at_ = before;
      on_ = before_on;
      go({scale * step.b, scale * step.c}, halvings == 0 ? stop : -1);
      const Expansion next = expansion(at_);
      if (next.value <= here_.value) {
        here_ = next;
        return true;
      }
    }
    at_ = before;
    on_ = before_on;
    return false;
  }

  PatchPolynomial patch_;  // relative to the point
  Parameters at_;
  OnSides on_;
  Expansion here_;
};

}  // namespace

Barycentric closest_on_patch(const Patch& patch, const Barycentric& start, const Vec3& x) {
  return Walk(patch, start, x).walk();
}

}  // namespace medial
