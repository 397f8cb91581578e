// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/crease_reach.h"

namespace medial {
namespace {

constexpr double kAccidentBall = 3.5;   // the same where it may be no crease; chosen: axis
constexpr double kOneDirection = 0.85;  // the cosine between creases of one way; chosen: unseen

Vec3 direction(const SamplesOnFaces& samples, int32_t edge) {
  const auto& mesh = samples.faces().mesh();
  const auto& [a, b] = samples.faces().creases().edges[edge].ends;
  return normalized(mesh.points[b] - mesh.points[a]);
}

}  // namespace

// Sharp edges that divide nothing are often accidents of a coarse mesh, and a zigzag only stands
// for a line, which is elsewhere.
double crease_reach(const SamplesOnFaces& samples, const PlaceOnCrease& place) {
  const ConvexCreases& creases = samples.creases();
  if (creases.is_fragment(place.edge) || creases.is_jagged(place.edge)) return 0;
  return creases.divides(place.edge) ? kCreaseBall : kAccidentBall;
}

bool same_direction(const SamplesOnFaces& samples, const PlaceOnCrease& a, const PlaceOnCrease& b) {
  if (a.edge == b.edge) return true;
  return std::abs(dot(direction(samples, a.edge), direction(samples, b.edge))) > kOneDirection;
}

}  // namespace medial
