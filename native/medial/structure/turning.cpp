// SPDX-License-Identifier: GPL-3.0-or-later
#include "structure/turning.h"

#include "base/union_find.h"

namespace medial {
namespace {

// Returns how much a facet, as it is, speaks for the direction of its sheet: its area if it leads
// from the lower patch to the higher one, less for the opposite, nothing if that is not known.
double vote_of(const Facets& facets, const Edge& label, int32_t facet) {
  const auto& [p, q] = facets.input.generators[facet];
  const Edge &from = facets.input.patches[p], &to = facets.input.patches[q];
  if (from[1] >= 0 || to[1] >= 0) return 0;
  if (from[0] == label[0] && to[0] == label[1]) return facets.area[facet];
  if (from[0] == label[1] && to[0] == label[0]) return -facets.area[facet];
  return 0;
}

double largest_coordinate(const Vec3& v) {
  const double size = max_abs(v);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(coordinate(v, axis)) == size) return coordinate(v, axis);
  }
  return 0;
}

}  // namespace

Column<uint8_t> turned_facets(const Facets& facets, const AxisParts& parts) {
  OrientedUnionFind sets(facets.area.size());
  for (int32_t e = 0; e < facets.edge_count(); ++e) {
    const auto at = facets.at_edge[e];
    if (at.size() != 2 || parts.of_facet[at[0]] != parts.of_facet[at[1]]) continue;
    const auto first = static_cast<size_t>(facets.at_edge.offsets[e]);
    sets.unite(at[0], at[1], facets.forward[first] == facets.forward[first + 1]);
  }
  std::vector<double> votes(facets.area.size(), 0);
  std::vector<Vec3> normals(facets.area.size());
  for (int32_t f = 0; f < facets.count(); ++f) {
    const auto [root, turned] = sets.find(f);
    const Edge& label = parts.label[parts.of_facet[f]];
    const double sign = turned ? -1 : 1;
    if (label[0] != label[1]) votes[root] += sign * vote_of(facets, label, f);
    normals[root] = normals[root] + sign * facets.normal[f];
  }
  Column<uint8_t> result(facets.area.size());
  for (int32_t f = 0; f < facets.count(); ++f) {
    const auto [root, turned] = sets.find(f);
    const double way = votes[root] != 0 ? votes[root] : largest_coordinate(normals[root]);
    result[f] = turned != (way < 0);
  }
  return result;
}

}  // namespace medial
