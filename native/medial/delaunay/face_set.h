// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of Delaunay triangles, and the walk from triangle to triangle round an edge.
#pragma once

#include "base/atomic.h"
#include "base/csr.h"
#include "base/triangle.h"
#include "delaunay/triangulation.h"

namespace medial {

// The Delaunay triangle opposite to cells[cell][slot], seen from that cell. Each triangle is seen
// from two cells.
struct CellFace {
  int32_t cell = -1;
  int slot = 0;

  friend bool operator==(const CellFace&, const CellFace&) = default;
};

// Corners of a face, counter-clockwise seen from its (positively oriented) cell.
inline Triangle corners(const Triangulation& triangulation, const CellFace& face) {
  constexpr int kFace[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
  const Cell& cell = triangulation.cells[face.cell];
  const auto& [i, j, k] = kFace[face.slot];
  return {cell[i], cell[j], cell[k]};
}

// The same triangle seen from the other cell.
inline CellFace mirror(const Triangulation& triangulation, const CellFace& face) {
  const int32_t across = triangulation.neighbors[face.cell][face.slot];
  return {across, slot_of(triangulation.neighbors[across], face.cell)};
}

// The corner of a face at the edge pq that is neither p nor q.
inline int32_t third_corner(const Triangulation& triangulation, const CellFace& face, int32_t p,
                            int32_t q) {
  const auto& [i, j, k, l] = triangulation.cells[face.cell];
  return i + j + k + l - triangulation.cells[face.cell][face.slot] - p - q;
}

// Facets as four bits per cell: a triangle may be in from one of its cells, or from both.
class FaceSet {
 public:
  explicit FaceSet(const Triangulation& triangulation) : bits_(triangulation.cells.size(), 0) {}

  bool has(const CellFace& f) const { return bits_[f.cell] >> f.slot & 1; }
  bool has_any(int32_t cell) const { return bits_[cell] != 0; }
  void insert(const CellFace& f) { bits_[f.cell] |= static_cast<uint8_t>(1 << f.slot); }
  void erase(const CellFace& f) { bits_[f.cell] &= static_cast<uint8_t>(~(1 << f.slot)); }
  // Insertion by several threads: the order does not matter.
  void insert_shared(const CellFace& f) {
    shared_or(bits_[f.cell], static_cast<uint8_t>(1 << f.slot));
  }

 private:
  std::vector<uint8_t> bits_;
};

// Call found(face) for the faces that a set holds: those seen from one cell; all, in order of
// their cells; those at corner p, which has the cells `incident`.
template <typename Found>
void for_faces_of(int32_t cell, const FaceSet& set, const Found& found) {
  if (!set.has_any(cell)) return;
  for (int slot = 0; slot < 4; ++slot) {
    if (set.has({cell, slot})) found(CellFace{cell, slot});
  }
}
template <typename Found>
void for_faces(const Triangulation& triangulation, const FaceSet& set, const Found& found) {
  for (int32_t cell = 0; cell < triangulation.cell_count(); ++cell) for_faces_of(cell, set, found);
}
template <typename Found>
void for_faces_at(int32_t p, const Triangulation& triangulation, std::span<const int32_t> incident,
                  const FaceSet& set, const Found& found) {
  for (const int32_t cell : incident) {
    for_faces_of(cell, set, [&](const CellFace& f) {
      if (triangulation.cells[cell][f.slot] != p) found(f);
    });
  }
}

// Triangles seen from both of their cells.
FaceSet from_both_sides(const Triangulation& triangulation, const FaceSet& set, const Run& run);
void insert_both(const Triangulation& triangulation, FaceSet& set, const CellFace& face);
void erase_both(const Triangulation& triangulation, FaceSet& set, const CellFace& face);

// Turns `from` about its edge pq, through the cell that it is seen from, to the next triangle of
// `set` (which must hold triangles from both sides); seen from the cell last passed. The other side
// of `from` when there is none.
inline CellFace next_about_edge(const Triangulation& t, const FaceSet& set, const CellFace& from,
                                int32_t p, int32_t q) {
  int32_t cell = from.cell, ahead = t.cells[cell][from.slot];
  int32_t behind = third_corner(t, from, p, q);
  for (;;) {
    // The face (p, q, ahead) lies opposite to the corner that is left behind.
    const CellFace f{cell, slot_of(t.cells[cell], behind)};
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
void walk_about_vertex(const Triangulation& triangulation, const FaceSet& set,
                       const CellFace& start, int32_t p, std::vector<CellFace>& steps);

// Puts the links of triangles at a vertex, their edges opposite to it, in order: each link ends
// where the next one starts, the last one where the first one starts. Whether that is possible and
// passes no sample twice: the triangles are one disc round the vertex.
bool put_in_cycle(std::vector<Edge>& links);

// Whether the triangles at p are one disc round it; each is in `faces` once. `links` is room to
// work in.
bool is_one_disc(const Triangulation& triangulation, std::span<const CellFace> faces, int32_t p,
                 std::vector<Edge>& links);

}  // namespace medial
