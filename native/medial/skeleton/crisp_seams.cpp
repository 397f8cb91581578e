// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

bool reaches_seam(const CrispState& state, int32_t v) {
  return state.made.place[v] == Placing::touching && state.walls[v].count >= 3;
}

int32_t neighbour_on_seam(const CrispState& state, int32_t v) {
  int32_t best = -1;
  const auto away = [&](int32_t other) {
    return distance(state.complex.position[other], state.complex.position[v]);
  };
  state.for_edges(v, [&](const Corner&, int32_t other) {
    if (!reaches_seam(state, other) || !state.on_seam[other]) return;
    if (best < 0 || away(other) < away(best) || (away(other) == away(best) && other < best)) {
      best = other;
    }
  });
  return best;
}

}  // namespace

void join_seams(CrispState& state) {
  state.follows = array<int32_t>(state.complex.cell.size(), -1, state.run);
  parallel_for(state.complex.vertices(), state.run, [&](int64_t id) {
    const auto v = static_cast<int32_t>(id);
    if (reaches_seam(state, v) && !state.on_seam[v]) {
      state.follows[v] = neighbour_on_seam(state, v);
    }
  });
  for (int32_t v = 0; v < state.complex.vertices(); ++v) {
    if (state.follows[v] >= 0) state.followers.push_back(v);
  }
  follow(state);
}

void follow(CrispState& state) {
  for (const int32_t v : state.followers) {
    state.made.position[v] = state.made.position[state.follows[v]];
    state.made.radius[v] = state.made.radius[state.follows[v]];
  }
}

}  // namespace medial
