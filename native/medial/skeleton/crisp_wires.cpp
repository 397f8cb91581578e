// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "base/portable_math.h"
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

constexpr double kBefore = 0.5;    // the cosine between a wire and the way to the wall before it
constexpr double kEndFarther = 1;  // holes that the end of a wire moves, at most

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

// Returns the ball that touches the wall before the end of a wire and a curved wall all round it.
Touch wire_end(const CrispState& state, int32_t v, int32_t next) {
  const Walls own = state.walls[v].count > 1 ? state.walls[v] : walls_at(state, v, true);
  if (own.count < 2) return {};
  const Touch at = touch(state, v, own, state.made.position[v]);
  if (!(at.radius > 0)) return {};
  const Vec3 along = normalized(state.complex.position[next] - at.position);
  Walls walls;
  const int32_t before = wall_before(at, along);
  if (before < 0) return {};
  walls.add(before);
  const auto [right, up] = across(along);
  for (int i = 0; i < 3; ++i) {
    const auto [sine, cosine] = portable::sine_cosine(i * 2 * std::numbers::pi / 3);
    const Vec3 out = cosine * right + sine * up;
    const int32_t t = state.samples.triangle_near(at.position + at.radius * out);
    if (t < 0 || !state.samples.faces().is_curved(t)) return {};
    walls.add(t);
  }
  return nearly_touching(state, v, walls, at.position, kEndFarther * state.spacing_at(v));
}

}  // namespace

void end_wires(CrispState& state) {
  for (const auto& [v, next] : state.wires) {
    if (state.made.place[v] != Placing::touching && state.made.place[v] != Placing::refused)
      continue;
    state.stays[v] = 1;  // where no ball is found, too: the whole wire begins there
    const Touch end = wire_end(state, v, next);
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
