// SPDX-License-Identifier: GPL-3.0-or-later
#include "structure/nodes.h"

#include <map>
#include <set>

#include "base/union_find.h"

namespace medial {
namespace {

// Finds the places where curves meet or end, and which of them are close to each other.
class Clusters {
 public:
  Clusters(const Facets& facets, const AxisCurves& curves) : facets_(facets), curves_(curves) {
    find_places();
    UnionFind sets(facets.input.vertices.size());
    for (int32_t e = 0; e < facets.edge_count(); ++e) {
      const int32_t curve = curves.of_edge[e];
      if (curve >= 0 && !curves.curves[curve].is_long()) {
        sets.unite(facets.edges.ends[e][0], facets.edges.ends[e][1]);
      }
    }
    unite_close(sets);
    collect(std::move(sets).representatives());
  }

  // The vertices of each cluster, ascending.
  const std::vector<std::vector<int32_t>>& all() const { return clusters_; }

 private:
  bool is_place(int32_t v) const {
    const auto at = curves_.at_vertex[v];
    if (at.size() == 1) return true;
    return std::any_of(at.begin(), at.end(), [&](int32_t e) {
      const int32_t curve = curves_.of_edge[e];
      return curve != curves_.of_edge[at[0]] || !curves_.curves[curve].is_long();
    });
  }

  void find_places() {
    spacing_.assign(facets_.input.vertices.size(), 0);
    for (int32_t v = 0; v < static_cast<int32_t>(spacing_.size()); ++v) {
      if (!is_place(v)) continue;
      places_.push_back(v);
      for (const int32_t e : curves_.at_vertex[v]) {
        spacing_[v] = std::max(spacing_[v], curves_.curves[curves_.of_edge[e]].spacing);
      }
    }
  }

  void unite_close(UnionFind& sets) const {
    const auto& at = facets_.input.vertices;
    auto sorted = places_;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](int32_t a, int32_t b) { return at[a].x < at[b].x; });
    for (size_t i = 0; i < sorted.size(); ++i) {
      const int32_t a = sorted[i];
      const double reach = kShortCurve * spacing_[a];
      for (size_t j = i + 1; j < sorted.size() && at[sorted[j]].x - at[a].x <= reach; ++j) {
        const int32_t b = sorted[j];
        const double within = std::min(reach, kShortCurve * spacing_[b]);
        if (distance(at[a], at[b]) <= within) sets.unite(a, b);
      }
    }
  }

  void collect(std::span<const int32_t> first) {
    std::map<int32_t, size_t> number;
    for (const int32_t v : places_) {
      const auto [at, is_new] = number.try_emplace(first[v], clusters_.size());
      if (is_new) clusters_.emplace_back();
      clusters_[at->second].push_back(v);
    }
  }

  const Facets& facets_;
  const AxisCurves& curves_;
  std::vector<int32_t> places_;
  std::vector<double> spacing_;  // (v) at the places
  std::vector<std::vector<int32_t>> clusters_;
};

// Returns the curves at some vertices.
std::set<int32_t> curves_at(const AxisCurves& curves, std::span<const int32_t> vertices) {
  std::set<int32_t> found;
  for (const int32_t v : vertices) {
    for (const int32_t e : curves.at_vertex[v]) found.insert(curves.of_edge[e]);
  }
  return found;
}

bool is_long_seam(const AxisCurve& curve) {
  return curve.kind == CurveKind::seam && curve.is_long();
}

int long_seams_at(const AxisCurves& curves, int32_t vertex) {
  const auto at = curves_at(curves, std::span(&vertex, 1));
  return static_cast<int>(std::count_if(at.begin(), at.end(),
                                        [&](int32_t c) { return is_long_seam(curves.curves[c]); }));
}

// Returns the vertex with the most long seams, of those the nearest to the middle of the cluster.
int32_t vertex_of_junction(const Facets& facets, const AxisCurves& curves,
                           std::span<const int32_t> cluster) {
  Vec3 middle{};
  for (const int32_t v : cluster) middle = middle + facets.input.vertices[v];
  middle = (1 / static_cast<double>(cluster.size())) * middle;
  const auto rank = [&](int32_t v) {
    return std::tuple(-long_seams_at(curves, v), distance(facets.input.vertices[v], middle), v);
  };
  return *std::min_element(cluster.begin(), cluster.end(),
                           [&](int32_t a, int32_t b) { return rank(a) < rank(b); });
}

int32_t vertex_of_corner(const Facets& facets, std::span<const int32_t> cluster) {
  return *std::min_element(cluster.begin(), cluster.end(), [&](int32_t a, int32_t b) {
    return facets.input.radius[a] < facets.input.radius[b];
  });
}

}  // namespace

void join_curves(const Facets& facets, AxisCurves& curves) {
  const Clusters clusters(facets, curves);
  UnionFind sets(curves.curves.size());
  for (const auto& cluster : clusters.all()) {
    std::map<std::pair<CurveKind, std::vector<int32_t>>, std::vector<int32_t>> alike;
    for (const int32_t c : curves_at(curves, cluster)) {
      alike[{curves.curves[c].kind, curves.curves[c].parts}].push_back(c);
    }
    for (const auto& [key, some] : alike) {
      const auto full = std::count_if(some.begin(), some.end(),
                                      [&](int32_t c) { return curves.curves[c].is_long(); });
      if (full > 2) continue;  // they meet here, and none is the continuation of another
      for (const int32_t c : some) sets.unite(some[0], c);
    }
  }
  const auto first = std::move(sets).representatives();
  for (int32_t& c : curves.of_edge) {
    if (c >= 0) c = first[c];
  }
  measure_curves(facets, curves);
}

std::vector<AxisNode> nodes_of(const Facets& facets, const AxisCurves& curves) {
  std::vector<AxisNode> nodes;
  const Clusters clusters(facets, curves);
  for (const auto& cluster : clusters.all()) {
    AxisNode node;
    int64_t seams = 0;
    bool at_crease = false;
    for (const int32_t c : curves_at(curves, cluster)) {
      const AxisCurve& curve = curves.curves[c];
      at_crease |= curve.kind == CurveKind::crease;
      seams += is_long_seam(curve);
      if (curve.is_long()) node.curves.push_back(c);
    }
    if (seams < (at_crease ? 1 : 3)) continue;
    node.kind = at_crease && seams < 3 ? PlaceKind::corner : PlaceKind::junction;
    node.vertex = node.kind == PlaceKind::corner ? vertex_of_corner(facets, cluster)
                                                 : vertex_of_junction(facets, curves, cluster);
    nodes.push_back(std::move(node));
  }
  return nodes;
}

}  // namespace medial
