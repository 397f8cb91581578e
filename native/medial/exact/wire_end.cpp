// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/wire_end.h"

#include <numbers>

#include "base/portable_math.h"

namespace medial {
namespace {

constexpr double kBefore = 0.5;  // the cosine between a wire and its wall; chosen: unseen

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

}  // namespace

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
