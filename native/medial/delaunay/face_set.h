// SPDX-License-Identifier: GPL-3.0-or-later
// This header has sets of Delaunay triangles, and the walk from triangle to triangle around an
// edge.
#pragma once

#include "base/atomic.h"
#include "base/csr.h"
#include "base/triangle.h"
#include "delaunay/triangulation.h"

namespace medial {

// Identifies the Delaunay triangle opposite to cells[cell][slot], as seen from that cell. Each
// triangle is seen from two cells.
struct CellFace {
  int32_t cell = -1;
  int slot = 0;

  friend bool operator==(const CellFace&, const CellFace&) = default;
};

// Returns the corners of a face, counter-clockwise as seen from its (positively oriented) cell.
inline Triangle corners(const Triangulation& triangulation, const CellFace& face) {
  constexpr int kFace[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
  const Cell& cell = triangulation.cells[face.cell];
  const auto& [i, j, k] = kFace[face.slot];
  return {cell[i], cell[j], cell[k]};
}

// Returns the same triangle as seen from the other cell.
inline CellFace mirror(const Triangulation& triangulation, const CellFace& face) {
  const int32_t across = triangulation.neighbors[face.cell][face.slot];
  return {across, slot_of(triangulation.neighbors[across], face.cell)};
}

// Returns the corner of a face at the edge pq that is neither p nor q.
inline int32_t third_corner(const Triangulation& triangulation, const CellFace& face, int32_t p,
                            int32_t q) {
  const auto& [i, j, k, l] = triangulation.cells[face.cell];
  return i + j + k + l - triangulation.cells[face.cell][face.slot] - p - q;
}

// Stores faces as four bits per cell: a triangle may be in the set from one of its cells, or from
// both.
class FaceSet {
 public:
  explicit FaceSet(const Triangulation& triangulation) : bits_(triangulation.cells.size(), 0) {}

  bool has(const CellFace& f) const { return bits_[f.cell] >> f.slot & 1; }
  bool has_any(int32_t cell) const { return bits_[cell] != 0; }
  void insert(const CellFace& f) { bits_[f.cell] |= static_cast<uint8_t>(1 << f.slot); }
  void erase(const CellFace& f) { bits_[f.cell] &= static_cast<uint8_t>(~(1 << f.slot)); }
  // Inserts a face; several threads may do so, and the order does not matter.
  void insert_shared(const CellFace& f) {
    shared_or(bits_[f.cell], static_cast<uint8_t>(1 << f.slot));
  }

 private:
  std::vector<uint8_t> bits_;
};

// These functions call found(face) for the faces in a set: those seen from one cell; all faces, in
// the order of their cells; and those at corner p, which has the cells `incident`.
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

// These functions treat triangles as seen from both of their cells.
FaceSet from_both_sides(const Triangulation& triangulation, const FaceSet& set, const Run& run);
void insert_both(const Triangulation& triangulation, FaceSet& set, const CellFace& face);
void erase_both(const Triangulation& triangulation, FaceSet& set, const CellFace& face);

// Turns `from` about its edge pq, through the cell from which it is seen, to the next triangle of
// `set`, which must have its triangles from both sides. Returns it as seen from the last cell on
// the way, or the other side of `from` if there is no other triangle.
inline CellFace next_about_edge(const Triangulation& t, const FaceSet& set, const CellFace& from,
                                int32_t p, int32_t q) {
  int32_t cell = from.cell, ahead = t.cells[cell][from.slot];
  int32_t behind = third_corner(t, from, p, q);
  for (;;) {
    // The face (p, q, ahead) is opposite to the corner that is left behind.
    const CellFace f{cell, slot_of(t.cells[cell], behind)};
    const int32_t next = t.neighbors[cell][f.slot];
    if (set.has(f) || next == from.cell) return f;
    const auto& [i, j, k, l] = t.cells[next];
    behind = ahead;
    ahead = i + j + k + l - p - q - behind;
    cell = next;
  }
}

// Replaces `steps` by the triangles at corner p that continue `start`, seen from one side, until
// the walk is back at `start`.
void walk_about_vertex(const Triangulation& triangulation, const FaceSet& set,
                       const CellFace& start, int32_t p, std::vector<CellFace>& steps);

// Orders the links of triangles at a vertex, which are their edges opposite to it: each link ends
// where the next one starts, and the last one where the first one starts. Returns whether that is
// possible without passing a sample twice; then the triangles are one disc around the vertex.
bool put_in_cycle(std::vector<Edge>& links);

// Returns whether the triangles at p are one disc around it; each is in `faces` once. `links` is a
// scratch buffer.
bool is_one_disc(const Triangulation& triangulation, std::span<const CellFace> faces, int32_t p,
                 std::vector<Edge>& links);

}  // namespace medial
