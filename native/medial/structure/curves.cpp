// SPDX-License-Identifier: GPL-3.0-or-later
#include "structure/curves.h"

#include <map>

#include "base/sort_unique.h"
#include "base/union_find.h"

namespace medial {
namespace {

constexpr double kAtCrease = 2;  // the largest radius at a crease, in spacings; chosen: unseen

// Returns the parts at an edge, ascending and each once.
std::vector<int32_t> parts_at(const Facets& facets, const AxisParts& parts, int32_t edge) {
  std::vector<int32_t> found;
  for (const int32_t f : facets.at_edge[edge]) found.push_back(parts.of_facet[f]);
  sort_unique(found);
  return found;
}

double spacing_at(const Facets& facets, int32_t edge) {
  double sum = 0;
  const auto at = facets.at_edge[edge];
  for (const int32_t f : at) sum += facets.spacing[f];
  return sum / static_cast<double>(at.size());
}

// A rim is at a crease if its sheet lies between two patches that come as close as samples are.
bool is_at_crease(const Facets& facets, const AxisParts& parts, int32_t edge) {
  const Edge& label = parts.label[parts.of_facet[facets.at_edge[edge][0]]];
  if (label[0] < 0 || label[0] == label[1]) return false;
  const auto& [a, b] = facets.edges.ends[edge];
  const double radius = std::max(facets.input.radius[a], facets.input.radius[b]);
  return radius < kAtCrease * spacing_at(facets, edge);
}

CurveKind kind_of(const Facets& facets, const AxisParts& parts, int32_t edge) {
  const auto at = facets.at_edge[edge];
  if (at.size() == 1) {
    return is_at_crease(facets, parts, edge) ? CurveKind::crease : CurveKind::rim;
  }
  const auto other = [&](int32_t f) { return parts.of_facet[f] != parts.of_facet[at[0]]; };
  if (std::any_of(at.begin(), at.end(), other)) return CurveKind::seam;
  // A sheet may meet itself, but its crumbs do not make a seam.
  const auto whole =
      std::count_if(at.begin(), at.end(), [&](int32_t f) { return !parts.crumb[f]; });
  return whole > 2 ? CurveKind::seam : CurveKind::none;
}

using Key = std::vector<int32_t>;  // the kind, then the parts

Key key_of(const Facets& facets, const AxisParts& parts, CurveKind kind, int32_t edge) {
  Key key{static_cast<int32_t>(kind)};
  for (const int32_t p : parts_at(facets, parts, edge)) key.push_back(p);
  return key;
}

Csr<int32_t> curve_edges_at_vertices(const Facets& facets, std::span<const CurveKind> kind,
                                     const Run& run) {
  std::vector<Edge> ends(facets.edges.ends);
  for (size_t e = 0; e < ends.size(); ++e) {
    if (kind[e] == CurveKind::none) ends[e] = {-1, -1};
  }
  return rows_containing(std::span<const Edge>(ends),
                         static_cast<int32_t>(facets.input.vertices.size()), run);
}

// Returns a number of the key of each edge of a curve, -1 for others; fills the keys.
std::vector<int32_t> keys_of(const Facets& facets, const AxisParts& parts,
                             std::span<const CurveKind> kind, std::vector<Key>& keys) {
  std::map<Key, int32_t> number;
  std::vector<int32_t> result(kind.size(), -1);
  for (int32_t e = 0; e < facets.edge_count(); ++e) {
    if (kind[e] == CurveKind::none) continue;
    Key key = key_of(facets, parts, kind[e], e);
    const auto [at, is_new] = number.try_emplace(key, static_cast<int32_t>(keys.size()));
    if (is_new) keys.push_back(std::move(key));
    result[e] = at->second;
  }
  return result;
}

// Returns the lowest edge of the curve of each edge.
Array<int32_t> connected(const AxisCurves& curves, std::span<const int32_t> key) {
  UnionFind sets(key.size());
  for (int64_t v = 0; v < curves.at_vertex.size(); ++v) {
    const auto at = curves.at_vertex[v];
    for (size_t i = 0; i < at.size(); ++i) {
      for (size_t j = i + 1; j < at.size(); ++j) {
        if (key[at[i]] == key[at[j]]) sets.unite(at[i], at[j]);
      }
    }
  }
  return std::move(sets).representatives();
}

}  // namespace

bool AxisCurve::is_long() const { return length > kShortCurve * spacing; }

AxisCurves curves_of(const Facets& facets, const AxisParts& parts, const Run& run) {
  AxisCurves curves;
  curves.kind.resize(facets.edges.ends.size());
  parallel_for(facets.edge_count(), run, [&](int64_t e) {
    curves.kind[e] = kind_of(facets, parts, static_cast<int32_t>(e));
  });
  curves.at_vertex = curve_edges_at_vertices(facets, curves.kind, run);
  std::vector<Key> keys;
  const auto key = keys_of(facets, parts, curves.kind, keys);
  const auto first = connected(curves, key);
  std::vector<int32_t> number(key.size(), -1);
  curves.of_edge.assign(key.size(), -1);
  for (size_t e = 0; e < key.size(); ++e) {
    if (key[e] < 0) continue;
    int32_t& curve = number[first[e]];
    if (curve < 0) {
      curve = static_cast<int32_t>(curves.curves.size());
      const Key& k = keys[key[e]];
      curves.curves.emplace_back();
      curves.curves.back().kind = static_cast<CurveKind>(k[0]);
      curves.curves.back().parts.assign(k.begin() + 1, k.end());
    }
    curves.of_edge[e] = curve;
  }
  measure_curves(facets, curves);
  return curves;
}

void measure_curves(const Facets& facets, AxisCurves& curves) {
  std::vector<int32_t> number(curves.curves.size(), -1);
  std::vector<AxisCurve> measured;
  for (int32_t e = 0; e < facets.edge_count(); ++e) {
    int32_t& curve = curves.of_edge[e];
    if (curve < 0) continue;
    if (number[curve] < 0) {
      number[curve] = static_cast<int32_t>(measured.size());
      measured.emplace_back();
      measured.back().kind = curves.curves[curve].kind;
      measured.back().parts = curves.curves[curve].parts;
      measured.back().least_radius = HUGE_VAL;
    }
    curve = number[curve];
    AxisCurve& c = measured[curve];
    const auto& [a, b] = facets.edges.ends[e];
    const double r = facets.input.radius[a], s = facets.input.radius[b], l = facets.length(e);
    c.length += l;
    c.spacing += l * spacing_at(facets, e);
    c.radius += l * 0.5 * (r + s);
    c.least_radius = std::min({c.least_radius, r, s});
    c.middle = c.middle + 0.5 * l * (facets.input.vertices[a] + facets.input.vertices[b]);
  }
  for (AxisCurve& c : measured) {
    if (!(c.length > 0)) continue;
    c.spacing /= c.length;
    c.radius /= c.length;
    c.middle = (1 / c.length) * c.middle;
  }
  curves.curves = std::move(measured);
}

}  // namespace medial
