// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

constexpr int kBisections = 20;  // of the way to the last ball that touches two places

}  // namespace

int32_t placed_neighbour(const CrispState& state, int32_t v) {
  int32_t best = -1;
  const auto away = [&](int32_t other) {
    return distance(state.complex.position[other], state.complex.position[v]);
  };
  for (const int32_t f : state.facets_at[v]) {
    for (const Corner& c : state.complex.ring(f)) {
      if (state.made.place[c.vertex] != Placing::touching) continue;
      if (best < 0 || away(c.vertex) < away(best)) best = c.vertex;
    }
  }
  return best >= 0 && state.walls[best].count == 2 ? best : -1;
}

Touch last_ball(const CrispState& state, int32_t v, const Walls& walls, const Vec3& inner,
                const Vec3& beyond, double openness_at_least) {
  Touch last;
  double low = 0, high = 1;
  for (int i = 0; i < kBisections; ++i) {
    const double share = 0.5 * (low + high);
    const Touch ball = touch(state, v, walls, (1 - share) * inner + share * beyond, 2);
    const bool ends = !(ball.radius > 0) || openness(ball.away) < openness_at_least;
    (ends ? high : low) = share;
    if (!ends) last = ball;
  }
  return last;
}

void end_fillets(CrispState& state) {
  const auto beyond =
      parallel_append<int32_t>(state.complex.vertices(), state.run, [&](int64_t v, auto& out, int) {
        if (state.on_rim[v] && state.made.place[v] == Placing::refused) {
          out.push_back(static_cast<int32_t>(v));
        }
      });
  std::vector<Touch> found(beyond.size());
  parallel_for(
      static_cast<int64_t>(beyond.size()), state.run,
      [&](int64_t i) {
        const int32_t v = beyond[i], inner = placed_neighbour(state, v);
        if (inner >= 0) {
          found[i] = last_ball(state, v, state.walls[inner], state.made.position[inner],
                               state.complex.position[v], 0);
        }
      },
      64);
  for (size_t i = 0; i < beyond.size(); ++i) {
    if (!(found[i].radius > 0)) continue;
    state.take(beyond[i], found[i]);
    state.made.place[beyond[i]] = Placing::touching;
  }
}

}  // namespace medial
