// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/betti.h"

#include "base/union_find.h"

namespace medial {
namespace {

int64_t count(std::span<const uint8_t> flags) {
  return std::count_if(flags.begin(), flags.end(), [](uint8_t flag) { return flag != 0; });
}

int64_t count_sets(std::span<const int32_t> representatives) {
  int64_t count = 0;
  for (size_t i = 0; i < representatives.size(); ++i) {
    count += representatives[i] == static_cast<int32_t>(i);
  }
  return count;
}

int64_t count_pieces(const InnerComplex& complex, const Alive& alive, const Run& run) {
  SharedUnionFind sets(complex.cell.size(), run);
  parallel_for(complex.edges(), run, [&](int64_t e) {
    if (alive.edge[e]) sets.unite(complex.ends[e][0], complex.ends[e][1]);
  });
  const auto lowest = std::move(sets).representatives(run);
  int64_t pieces = 0;
  for (int32_t v = 0; v < complex.vertices(); ++v) pieces += alive.vertex[v] && lowest[v] == v;
  return pieces;
}

// Counts the cavities. A shrunk facet is alive if the edge or vertex that it shrank to is.
int64_t count_cavities(const InnerComplex& complex, std::span<const int32_t> outside,
                       const Alive& alive, const Run& run) {
  SharedUnionFind sets(outside.size(), run);
  parallel_for(static_cast<int64_t>(outside.size()), run,
               [&](int64_t p) { sets.unite(static_cast<int32_t>(p), outside[p]); });
  parallel_for(complex.facets(), run, [&](int64_t f) {
    if (!alive.facet[f]) sets.unite(complex.generators[f][0], complex.generators[f][1]);
  });
  for (const ShrunkFacet& s : complex.shrunk) {
    const bool there = s.edge >= 0 ? alive.edge[s.edge] : alive.vertex[s.vertex];
    if (!there) sets.unite(s.generators[0], s.generators[1]);
  }
  return count_sets(std::move(sets).representatives(run)) - 1;
}

}  // namespace

Array<int32_t> outside_components(const InnerComplex& complex, int32_t samples,
                                  const Triangulation& t, const Edges& edges, const Run& run) {
  auto in_complex = array<uint8_t>(edges.ends.size(), 0, run);
  parallel_for(complex.facets(), run, [&](int64_t f) { in_complex[complex.dual[f]] = 1; });
  for (const ShrunkFacet& s : complex.shrunk) in_complex[s.dual] = 1;
  SharedUnionFind sets(static_cast<size_t>(samples) + 1, run);
  parallel_for(edges.count(), run, [&](int64_t e) {
    if (!in_complex[e]) sets.unite(edges.ends[e][0], edges.ends[e][1]);
  });
  const auto is_far = [&](int32_t id) { return id == kInfinite || id >= samples; };
  parallel_for(t.cell_count(), run, [&](int64_t c) {
    const Cell& cell = t.cells[c];
    if (std::none_of(cell.begin(), cell.end(), is_far)) return;
    for (const int32_t id : cell) sets.unite(is_far(id) ? samples : id, samples);
  });
  const auto found = std::move(sets).representatives(run);
  return {found.begin(), found.end()};
}

Betti betti_of(const InnerComplex& complex, std::span<const int32_t> outside, const Run& run) {
  SharedUnionFind sets(complex.cell.size(), run);
  parallel_for(complex.edges(), run,
               [&](int64_t e) { sets.unite(complex.ends[e][0], complex.ends[e][1]); });
  const auto bubbles = static_cast<int64_t>(complex.bubbles.size());
  const int64_t pieces = count_sets(std::move(sets).representatives(run));
  const int64_t cavities = count_sets(outside) - bubbles - 1;
  const int64_t euler = complex.vertices() - complex.edges() + complex.facets() - bubbles;
  return {pieces, pieces + cavities - euler, cavities};
}

Betti betti_of(const InnerComplex& complex, std::span<const int32_t> outside, const Alive& alive,
               const Run& run) {
  return betti_of(complex, count_cavities(complex, outside, alive, run), alive, run);
}

Betti betti_of(const InnerComplex& complex, int64_t cavities, const Alive& alive, const Run& run) {
  const int64_t pieces = count_pieces(complex, alive, run);
  const int64_t euler = count(alive.vertex) - count(alive.edge) + count(alive.facet);
  return {pieces, pieces + cavities - euler, cavities};
}

}  // namespace medial
