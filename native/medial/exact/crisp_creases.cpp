// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/crease_reach.h"
#include "exact/crisp_parts.h"

namespace medial {

CreaseRims::CreaseRims(CrispState& state) : c_(state) {
  std::vector<Vec3> corners;
  const auto& mesh = c_.samples.faces().mesh();
  for (size_t p = 0; p < mesh.points.size(); ++p) {
    if (c_.samples.creases().is_corner(static_cast<int32_t>(p))) corners.push_back(mesh.points[p]);
  }
  if (!corners.empty()) corners_ = PointTree::sorted(corners, c_.run);
  corner_points_ = std::move(corners);
}

bool CreaseRims::onto_crease(int32_t v) {
  const double spacing = c_.spacing_at(v);
  if (!(c_.complex.radius[v] < kCreaseBall * spacing)) return false;
  std::optional<PlaceOnCrease> nearest;
  bool at_corner = false, ends = false;
  for (const int32_t f : c_.facets_at[v]) {
    const auto found = c_.samples.crease_between(c_.complex.generators[f], c_.complex.position[v]);
    if (!found || distance(found->point, c_.complex.position[v]) >
                      crease_reach(c_.samples, *found) * spacing) {
      continue;
    }
    ends = ends || ends_at(f, v);
    if (nearest && !same_direction(c_.samples, *nearest, *found)) at_corner = true;
    if (!nearest || distance(found->point, c_.complex.position[v]) <
                        distance(nearest->point, c_.complex.position[v])) {
      nearest = found;
    }
  }
  if (!nearest || !ends) return false;
  c_.made.position[v] = nearest->point;
  c_.made.radius[v] = 0;
  c_.made.place[v] = Placing::crease;
  if (at_corner) onto_corner(v, kCreaseBall * spacing);
  return true;
}

// Where the rim of one sheet meets the middle of another, only the first one ends, and the crease
// into which the second one leads is farther on.
bool CreaseRims::ends_at(int32_t facet, int32_t v) const {
  const auto ring = c_.complex.ring(facet);
  for (size_t i = 0; i < ring.size(); ++i) {
    if (c_.edge_uses[ring[i].edge] != 1) continue;
    if (ring[i].vertex == v || ring[(i + 1) % ring.size()].vertex == v) return true;
  }
  return false;
}

void CreaseRims::onto_corner(int32_t v, double within) {
  if (corner_points_.empty()) return;
  const Neighbour nearest = corners_.nearest(c_.complex.position[v]);
  if (nearest.distance > within) return;
  c_.made.position[v] = corner_points_[nearest.id];
  c_.made.place[v] = Placing::corner;
}

void CreaseRims::reach_corners() {
  if (corner_points_.empty()) return;
  std::vector<uint8_t> reached(corner_points_.size(), 0);
  std::vector<int32_t> on_crease;
  std::vector<Vec3> places;
  for (int32_t v = 0; v < c_.complex.vertices(); ++v) {
    if (c_.made.place[v] == Placing::corner) {
      reached[corners_.nearest(c_.made.position[v]).id] = 1;
    } else if (c_.made.place[v] == Placing::crease) {
      on_crease.push_back(v);
      places.push_back(c_.made.position[v]);
    }
  }
  if (places.empty()) return;
  const PointTree tree = PointTree::sorted(places, c_.run);
  for (size_t c = 0; c < reached.size(); ++c) {
    if (reached[c]) continue;
    const Neighbour nearest = tree.nearest(corner_points_[c]);
    const int32_t v = on_crease[nearest.id];
    if (nearest.distance > kCornerReach * c_.spacing_at(v)) continue;
    c_.made.position[v] = corner_points_[c];
    c_.made.place[v] = Placing::corner;
  }
}

}  // namespace medial
