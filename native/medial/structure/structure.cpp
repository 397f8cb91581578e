// SPDX-License-Identifier: GPL-3.0-or-later
#include <medial/structure.h>

#include "base/union_find.h"
#include "structure/nodes.h"
#include "structure/places.h"

namespace medial {
namespace {

// Numbers the long curves in their order and puts them into the result; returns the number of each
// curve, or -1.
std::vector<int32_t> put_curves(const AxisCurves& curves, Structure& s) {
  std::vector<int32_t> ids;
  std::vector<Placed> things;
  for (int32_t c = 0; c < static_cast<int32_t>(curves.curves.size()); ++c) {
    const AxisCurve& curve = curves.curves[c];
    if (!curve.is_long()) continue;
    ids.push_back(c);
    Placed thing{{static_cast<int32_t>(curve.kind)}, curve.middle, curve.spacing};
    thing.keys.insert(thing.keys.end(), curve.parts.begin(), curve.parts.end());
    things.push_back(std::move(thing));
  }
  std::vector<int32_t> number(curves.curves.size(), -1);
  s.curve_part_offsets = {0};
  for (const int32_t i : order_of(things)) {
    const AxisCurve& curve = curves.curves[ids[i]];
    number[ids[i]] = static_cast<int32_t>(s.curve_kind.size());
    s.curve_kind.push_back(curve.kind);
    s.curve_length.push_back(curve.length);
    s.curve_mean_radius.push_back(curve.radius);
    s.curve_least_radius.push_back(curve.least_radius);
    s.curve_parts.insert(s.curve_parts.end(), curve.parts.begin(), curve.parts.end());
    s.curve_part_offsets.push_back(static_cast<int32_t>(s.curve_parts.size()));
  }
  for (const int32_t c : curves.of_edge) s.curve.push_back(c < 0 ? -1 : number[c]);
  return number;
}

void put_nodes(const Facets& facets, std::vector<AxisNode> nodes, std::span<const int32_t> number,
               Structure& s) {
  std::vector<Placed> things;
  for (AxisNode& node : nodes) {
    for (int32_t& c : node.curves) c = number[c];
    std::sort(node.curves.begin(), node.curves.end());
    Placed thing{{static_cast<int32_t>(node.kind)}, facets.input.vertices[node.vertex], 0};
    thing.keys.insert(thing.keys.end(), node.curves.begin(), node.curves.end());
    things.push_back(std::move(thing));
  }
  s.node_curve_offsets = {0};
  for (const int32_t i : order_of(things)) {
    const AxisNode& node = nodes[i];
    s.node_kind.push_back(node.kind);
    s.node_vertex.push_back(node.vertex);
    s.node_curves.insert(s.node_curves.end(), node.curves.begin(), node.curves.end());
    s.node_curve_offsets.push_back(static_cast<int32_t>(s.node_curves.size()));
  }
}

void put_parts(const Facets& facets, const AxisParts& parts, Structure& s) {
  const auto count = static_cast<size_t>(parts.count());
  s.part.assign(parts.of_facet.begin(), parts.of_facet.end());
  s.part_patches.assign(parts.label.begin(), parts.label.end());
  s.part_area.assign(count, 0);
  s.part_mean_radius.assign(count, 0);
  s.part_least_radius.assign(count, HUGE_VAL);
  for (int32_t f = 0; f < facets.count(); ++f) {
    const int32_t p = s.part[f];
    s.part_area[p] += facets.area[f];
    s.part_mean_radius[p] += facets.area[f] * facets.radius[f];
    for (const int32_t v : facets.corners(f)) {
      s.part_least_radius[p] = std::min(s.part_least_radius[p], facets.input.radius[v]);
    }
  }
  for (size_t p = 0; p < count; ++p) {
    s.part_mean_radius[p] =
        s.part_area[p] > 0 ? s.part_mean_radius[p] / s.part_area[p] : s.part_least_radius[p];
  }
}

// A seam that ends at a rim counts as a seam there.
void put_places(const Facets& facets, const AxisCurves& curves, Structure& s) {
  s.kind.assign(facets.input.vertices.size(), PlaceKind::wire);
  for (const int32_t v : facets.input.face_vertices) s.kind[v] = PlaceKind::sheet;
  for (const bool seams : {false, true}) {
    for (int32_t e = 0; e < facets.edge_count(); ++e) {
      if (curves.kind[e] == CurveKind::none || (curves.kind[e] == CurveKind::seam) != seams)
        continue;
      for (const int32_t v : facets.edges.ends[e]) {
        s.kind[v] = seams ? PlaceKind::seam : PlaceKind::rim;
      }
    }
  }
  for (size_t n = 0; n < s.node_vertex.size(); ++n) s.kind[s.node_vertex[n]] = s.node_kind[n];
}

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

// Returns for each facet whether it must be turned to agree with its sheet, so that it looks
// smooth and can be given a thickness. A sheet between two
// patches is seen from the higher one; the largest coordinate of the normals of others is positive.
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

}  // namespace

Structure structure_of(const StructureInput& input, int threads) {
  const Run run{thread_count(threads)};
  const Facets facets = facets_of(input, run);
  const AxisParts parts = parts_of(facets, run);
  AxisCurves curves = curves_of(facets, parts, run);
  join_curves(facets, curves);
  Structure s;
  s.turned = turned_facets(facets, parts);
  put_parts(facets, parts, s);
  const auto number = put_curves(curves, s);
  put_nodes(facets, nodes_of(facets, curves), number, s);
  put_places(facets, curves, s);
  s.edges.assign(facets.edges.ends.begin(), facets.edges.ends.end());
  s.seam.assign(curves.kind.begin(), curves.kind.end());
  return s;
}

}  // namespace medial
