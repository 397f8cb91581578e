// SPDX-License-Identifier: GPL-3.0-or-later
// The Delaunay edges have dual Voronoi facets, which are represented as rings of cells.
#pragma once

#include "base/csr.h"
#include "base/triangle.h"
#include "delaunay/triangulation.h"

namespace medial {

// Holds the Delaunay edges between samples 0..n-1, each once, at the end with the lower input row.
struct Edges {
  Array<Edge> ends;      // sample ids
  Array<int32_t> cell;   // a cell of the ring; infinite exactly if the dual facet is unbounded
  Array<int32_t> first;  // (n + 1) the edges from sample p are first[p] .. first[p + 1]

  int64_t count() const { return static_cast<int64_t>(ends.size()); }
};

// Returns the cells, finite ones first, at each of the first `samples` points.
Csr<int32_t> incident_cells(const Triangulation& triangulation, int32_t samples, const Run& run);

// Returns the edges; `row` is the input row of each sample. The edges from one sample are in
// ascending order of the rows of their other ends.
Edges delaunay_edges(const Triangulation& triangulation, const Csr<int32_t>& incident,
                     std::span<const int32_t> row, const Run& run);

// The value kNext[i][j] = k makes the permutation (i, j, k, l) of (0, 1, 2, 3) even.
inline constexpr int kNext[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};

// Calls visit(cell, slot) for the cells around an edge, counter-clockwise about the direction from
// ends[0] to ends[1], starting at `cell`; the next cell is across `slot`. Stops where visit returns
// false. Returns whether visit was always true.
template <typename Visit>
bool walk_ring(const Triangulation& t, const Edge& ends, int32_t cell, const Visit& visit) {
  const int i = slot_of(t.cells[cell], ends[0]), j = slot_of(t.cells[cell], ends[1]);
  int leave = kNext[i][j];
  int32_t keep = t.cells[cell][6 - i - j - leave];
  int32_t c = cell;
  do {
    if (!visit(c, leave)) return false;
    c = t.neighbors[c][leave];
    // The walk crosses the facet (ends, keep): the next step leaves `keep` behind and keeps the
    // fourth corner.
    leave = slot_of(t.cells[c], keep);
    const Cell& ids = t.cells[c];
    keep = ids[0] + ids[1] + ids[2] + ids[3] - ends[0] - ends[1] - keep;
  } while (c != cell);
  return true;
}

// Clears `ring` and writes the cells around an edge to it, which are the vertices of its Voronoi
// facet.
void ring_of_cells(const Triangulation& triangulation, const Edge& ends, int32_t cell,
                   std::vector<int32_t>& ring);

// Returns for each cell whether its Voronoi vertex is in a facet dual to one of `edge_ids`.
std::vector<uint8_t> cells_round(std::span<const int32_t> edge_ids,
                                 const Triangulation& triangulation, const Edges& edges,
                                 const Run& run);

}  // namespace medial
