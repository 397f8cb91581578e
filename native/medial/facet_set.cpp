#include "facet_set.h"

#include <algorithm>

namespace medial {
namespace {

// Corners of a positively oriented cell opposite to each slot, counter-clockwise seen from inside.
constexpr int kFacet[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

}  // namespace

Triangle corners(const Triangulation& t, const Facet& f) {
  const Cell& cell = t.cells[f.cell];
  const auto& [i, j, k] = kFacet[f.slot];
  return {cell[i], cell[j], cell[k]};
}

FacetSet from_both_sides(const Triangulation& t, const FacetSet& set) {
  FacetSet both(t);
  for_facets(t, set, [&](const Facet& f) { insert_both(t, both, f); });
  return both;
}

void insert_both(const Triangulation& t, FacetSet& set, const Facet& f) {
  set.insert(f);
  set.insert(mirror(t, f));
}

void erase_both(const Triangulation& t, FacetSet& set, const Facet& f) {
  set.erase(f);
  set.erase(mirror(t, f));
}

Facet next_about_edge(const Triangulation& t, const FacetSet& set, const Facet& from, int32_t p,
                      int32_t q) {
  int32_t cell = from.cell, ahead = t.cells[cell][from.slot];
  int32_t behind = third_corner(t, from, p, q);
  for (;;) {
    // The facet (p, q, ahead) lies opposite to the corner that is left behind.
    const Facet f{cell, slot_of(t.cells[cell], behind)};
    if (set.has(f)) return f;
    const Facet across = mirror(t, f);
    if (across == from) return f;
    cell = across.cell;
    behind = ahead;
    ahead = t.cells[cell][across.slot];
  }
}

void walk_about_vertex(const Triangulation& t, const FacetSet& set, const Facet& start, int32_t p,
                       std::vector<Step>& steps) {
  steps.clear();
  const Triangle seen = corners(t, start);
  Facet f = start;
  int32_t link = seen[0] != p ? seen[0] : seen[1];
  do {
    steps.push_back({f, link});
    f = next_about_edge(t, set, f, p, link);
    link = third_corner(t, f, p, link);
  } while (!(f == start));
}

bool is_disc(std::span<const Step> steps) {
  if (steps.size() < 3) return false;
  for (size_t i = 0; i < steps.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (steps[i].link == steps[j].link) return false;
    }
  }
  return true;
}

bool is_one_disc(const Triangulation& t, const FacetSet& surface, std::span<const Facet> facets,
                 int32_t p, std::vector<Step>& steps) {
  if (facets.empty()) return false;
  walk_about_vertex(t, surface, facets.front(), p, steps);
  if (steps.size() != facets.size() || !is_disc(steps)) return false;
  return std::all_of(steps.begin(), steps.end(), [&](const Step& step) {
    return std::find(facets.begin(), facets.end(), step.facet) != facets.end();
  });
}

}  // namespace medial
