// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp_parts.h"
#include "skeleton/wire_end.h"

namespace medial {
namespace {

Touch wire_end_of(const CrispState& state, int32_t v, int32_t next) {
  const Walls own = state.walls[v].count > 1 ? state.walls[v] : walls_at(state, v, true);
  if (own.count < 2) return {};
  const Touch at = touch(state, v, own, state.made.position[v]);
  if (!(at.radius > 0)) return {};
  const Vec3 along = normalized(state.complex.position[next] - at.position);
  return wire_end(state.samples, state.spacing_at(v), at, along);
}

}  // namespace

void end_wires(CrispState& state) {
  for (const auto& [v, next] : state.wires) {
    if (state.made.place[v] != Placing::touching && state.made.place[v] != Placing::refused)
      continue;
    state.stays[v] = 1;  // where no ball is found, too: the whole wire begins there
    const Touch end = wire_end_of(state, v, next);
    if (!(end.radius > 0)) continue;
    state.take(v, end);
    state.made.place[v] = Placing::touching;
    state.follows[v] = -1;
  }
  std::erase_if(state.followers, [&](int32_t v) { return state.follows[v] < 0; });
}

std::vector<Vec3> tips_of(const Faces& faces) {
  const auto& mesh = faces.mesh();
  std::vector<uint8_t> on_crease(mesh.points.size(), 0);
  for (const MeshEdge& edge : faces.creases().edges) {
    if (edge.crease == Crease::none) continue;
    for (const int32_t end : edge.ends) on_crease[end] = 1;
  }
  std::vector<Vec3> tips;
  for (size_t p = 0; p < mesh.points.size(); ++p) {
    if (faces.creases().corner[p] && !on_crease[p]) tips.push_back(mesh.points[p]);
  }
  return tips;
}

}  // namespace medial
