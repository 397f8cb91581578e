#include "solid.h"

namespace medial {
namespace {

// The boundary, seen from outside.
FacetSet outer_facets(const Triangulation& t, const CellSides& sides, const Run& run) {
  FacetSet result(t);
  const auto inner = static_cast<uint8_t>(Side::inner);
  parallel_for(t.cell_count(), run, [&](int64_t c) {
    for (int i = 0; i < 4; ++i) {
      const Facet f{static_cast<int32_t>(c), i};
      if (sides[c] != inner && sides[t.neighbors[c][i]] == inner) result.insert(f);
    }
  });
  return result;
}

int64_t count_nonmanifold_vertices(const Triangulation& t, const Csr<int32_t>& incident,
                                   const FacetSet& outer, const FacetSet& surface, const Run& run) {
  const auto found =
      parallel_append<int32_t>(incident.size(), run, [&](int64_t id, auto& out, int) {
        const auto p = static_cast<int32_t>(id);
        std::vector<Facet> facets;
        std::vector<Step> steps;
        for_facets_at(p, t, incident[p], outer, [&](const Facet& f) { facets.push_back(f); });
        if (!facets.empty() && !is_one_disc(t, surface, facets, p, steps)) out.push_back(p);
      });
  return static_cast<int64_t>(found.size());
}

int64_t count_nonmanifold_edges(const Triangulation& t, const FacetSet& outer,
                                const FacetSet& surface, const Run& run) {
  auto found = parallel_append<Edge>(t.cell_count(), run, [&](int64_t c, auto& out, int) {
    for (int i = 0; i < 4; ++i) {
      const Facet f{static_cast<int32_t>(c), i};
      if (!outer.has(f)) continue;
      const Triangle ids = corners(t, f);
      for (const int32_t x : ids) {
        const auto [p, q] = link_of(ids, x);
        const Facet ahead = next_about_edge(t, surface, f, p, q);
        const Facet behind = next_about_edge(t, surface, mirror(t, f), p, q);
        if (!(mirror(t, ahead) == behind)) out.push_back({std::min(p, q), std::max(p, q)});
      }
    }
  });
  std::sort(found.begin(), found.end());
  return std::unique(found.begin(), found.end()) - found.begin();
}

}  // namespace

SolidBoundary solid_boundary(const Triangulation& t, const Csr<int32_t>& incident,
                             const CellSides& sides, const Run& run) {
  const FacetSet outer = outer_facets(t, sides, run), surface = from_both_sides(t, outer);
  SolidBoundary result;
  result.on_surface.assign(static_cast<size_t>(incident.size()), 0);
  for_facets(t, outer, [&](const Facet& f) {
    result.triangles.push_back(corners(t, f));
    for (const int32_t p : result.triangles.back()) result.on_surface[p] = 1;
  });
  result.nonmanifold_vertices = count_nonmanifold_vertices(t, incident, outer, surface, run);
  result.nonmanifold_edges = count_nonmanifold_edges(t, outer, surface, run);
  result.inner_cells = std::count(sides.begin(), sides.end(), static_cast<uint8_t>(Side::inner));
  return result;
}

}  // namespace medial
