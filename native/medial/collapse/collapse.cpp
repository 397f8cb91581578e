// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/collapse.h"

namespace medial {

Collapse whole(const InnerComplex& complex, const FacetWeights& weight, const Run& run) {
  const auto edges = static_cast<size_t>(complex.edges());
  Collapse collapse{Array<int32_t>(edges, kAlone), array<int32_t>(complex.cell.size(), -1, run),
                    array<uint8_t>(complex.dual.size(), 0, run),
                    array<Incident>(edges, Incident{}, run), array<uint8_t>(0, run)};
  parallel_for(complex.facets(), run, [&](int64_t f) {
    for (const Corner& c : complex.ring(static_cast<int32_t>(f))) {
      collapse.facets_at[c.edge].add_shared(static_cast<int32_t>(f));
    }
  });
  if (!complex.shrunk.empty()) collapse.selected.resize(edges, 0);
  for (const ShrunkFacet& s : complex.shrunk) {
    if (s.edge >= 0 && weight.selected(s.dual)) collapse.selected[s.edge] = 1;
  }
  return collapse;
}

Array<Incident> edges_left(const InnerComplex& complex, const Collapse& collapse, const Run& run) {
  auto left = array<Incident>(complex.cell.size(), Incident{}, run);
  parallel_for(complex.edges(), run, [&](int64_t e) {
    if (collapse.edge_gone(static_cast<int32_t>(e))) return;
    for (const int32_t v : complex.ends[e]) left[v].add_shared(static_cast<int32_t>(e));
  });
  return left;
}

}  // namespace medial
