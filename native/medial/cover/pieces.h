// SPDX-License-Identifier: GPL-3.0-or-later
// This cuts triangles into small pieces.
#pragma once

#include <algorithm>

#include "base/run.h"
#include "base/vec3.h"

namespace medial {

inline constexpr double kLongEdge = 64;    // pieces along an edge of a slow triangle; work: time
inline constexpr int64_t kTriangles = 16;  // triangles in one piece of work

// Halves a triangle across its longest edge until that is at most `piece`, and calls
// visit(a, b, c) for each part.
template <typename Visit>
void visit_pieces(const Vec3& a, const Vec3& b, const Vec3& c, double piece,
                  const Progress* progress, const Visit& visit) {
  const double ab = distance(a, b), bc = distance(b, c), ca = distance(c, a);
  const double longest = std::max({ab, bc, ca});
  if (longest > kLongEdge * piece) throw_if_cancelled(progress);
  const auto halve = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 middle = 0.5 * p + 0.5 * q;
    visit_pieces(p, middle, r, piece, progress, visit);
    visit_pieces(middle, q, r, piece, progress, visit);
  };
  if (longest <= piece) {
    visit(a, b, c);
  } else if (ab >= bc && ab >= ca) {
    halve(a, b, c);
  } else if (bc >= ca) {
    halve(b, c, a);
  } else {
    halve(c, a, b);
  }
}

}  // namespace medial
