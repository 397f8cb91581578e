// Sets of Delaunay triangles, and the walk from triangle to triangle round an edge.
#pragma once

#include <atomic>

#include "boundary.h"
#include "triangulation.h"

namespace medial {

// The Delaunay triangle opposite to cells[cell][slot], seen from that cell. Each triangle is seen
// from two cells.
struct Facet {
  int32_t cell = -1;
  int slot = 0;

  friend bool operator==(const Facet&, const Facet&) = default;
};

// Corners of a facet, counter-clockwise seen from its (positively oriented) cell.
inline Triangle corners(const Triangulation& triangulation, const Facet& facet) {
  constexpr int kFacet[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
  const Cell& cell = triangulation.cells[facet.cell];
  const auto& [i, j, k] = kFacet[facet.slot];
  return {cell[i], cell[j], cell[k]};
}

// The same triangle seen from the other cell.
inline Facet mirror(const Triangulation& triangulation, const Facet& facet) {
  const int32_t across = triangulation.neighbors[facet.cell][facet.slot];
  return {across, slot_of(triangulation.neighbors[across], facet.cell)};
}

// The corner of a facet at the edge pq that is neither p nor q.
inline int32_t third_corner(const Triangulation& triangulation, const Facet& facet, int32_t p,
                            int32_t q) {
  const auto& [i, j, k, l] = triangulation.cells[facet.cell];
  return i + j + k + l - triangulation.cells[facet.cell][facet.slot] - p - q;
}

// Facets as four bits per cell: a triangle may be in from one of its cells, or from both.
class FacetSet {
 public:
  explicit FacetSet(const Triangulation& triangulation) : bits_(triangulation.cells.size(), 0) {}

  bool has(const Facet& f) const { return bits_[f.cell] >> f.slot & 1; }
  bool has_any(int32_t cell) const { return bits_[cell] != 0; }
  void insert(const Facet& f) { bits_[f.cell] |= static_cast<uint8_t>(1 << f.slot); }
  void erase(const Facet& f) { bits_[f.cell] &= static_cast<uint8_t>(~(1 << f.slot)); }
  // Insertion by several threads: the order does not matter.
  void insert_shared(const Facet& f) {
    std::atomic_ref(bits_[f.cell])
        .fetch_or(static_cast<uint8_t>(1 << f.slot), std::memory_order_relaxed);
  }

 private:
  std::vector<uint8_t> bits_;
};

// Call found(facet) for the facets that a set holds: those seen from one cell; all, in order of
// their cells; those at corner p, which has the cells `incident`.
template <typename Found>
void for_facets_of(int32_t cell, const FacetSet& set, const Found& found) {
  if (!set.has_any(cell)) return;
  for (int slot = 0; slot < 4; ++slot) {
    if (set.has({cell, slot})) found(Facet{cell, slot});
  }
}
template <typename Found>
void for_facets(const Triangulation& triangulation, const FacetSet& set, const Found& found) {
  for (int32_t cell = 0; cell < triangulation.cell_count(); ++cell) for_facets_of(cell, set, found);
}
template <typename Found>
void for_facets_at(int32_t p, const Triangulation& triangulation, std::span<const int32_t> incident,
                   const FacetSet& set, const Found& found) {
  for (const int32_t cell : incident) {
    for_facets_of(cell, set, [&](const Facet& f) {
      if (triangulation.cells[cell][f.slot] != p) found(f);
    });
  }
}

// Triangles seen from both of their cells.
FacetSet from_both_sides(const Triangulation& triangulation, const FacetSet& set, const Run& run);
void insert_both(const Triangulation& triangulation, FacetSet& set, const Facet& facet);
void erase_both(const Triangulation& triangulation, FacetSet& set, const Facet& facet);

// Turns `from` about its edge pq, through the cell that it is seen from, to the next triangle of
// `set` (which must hold triangles from both sides); seen from the cell last passed. The other side
// of `from` when there is none.
inline Facet next_about_edge(const Triangulation& t, const FacetSet& set, const Facet& from,
                             int32_t p, int32_t q) {
  int32_t cell = from.cell, ahead = t.cells[cell][from.slot];
  int32_t behind = third_corner(t, from, p, q);
  for (;;) {
    // The facet (p, q, ahead) lies opposite to the corner that is left behind.
    const Facet f{cell, slot_of(t.cells[cell], behind)};
    const int32_t next = t.neighbors[cell][f.slot];
    if (set.has(f) || next == from.cell) return f;
    const auto& [i, j, k, l] = t.cells[next];
    behind = ahead;
    ahead = i + j + k + l - p - q - behind;
    cell = next;
  }
}

// The triangles at corner p that continue `start`, seen from one side, until the walk is back at
// `start`; replaces `steps`.
void walk_about_vertex(const Triangulation& triangulation, const FacetSet& set, const Facet& start,
                       int32_t p, std::vector<Facet>& steps);

// Puts the links of triangles at a vertex, their edges opposite to it, in order: each link ends
// where the next one starts, the last one where the first one starts. Whether that is possible and
// passes no sample twice: the triangles are one disc round the vertex.
bool chain(std::vector<Edge>& links);

// Whether the triangles at p are one disc round it; each is in `facets` once. `links` is room to
// work in.
bool is_one_disc(const Triangulation& triangulation, std::span<const Facet> facets, int32_t p,
                 std::vector<Edge>& links);

}  // namespace medial
