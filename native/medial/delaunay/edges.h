// SPDX-License-Identifier: GPL-3.0-or-later
// The Delaunay edges and their dual Voronoi facets, as rings of cells.
#pragma once

#include "base/csr.h"
#include "base/triangle.h"
#include "delaunay/triangulation.h"

namespace medial {

// Delaunay edges between samples 0..n-1, each once: from the end with the lower input row.
struct Edges {
  Array<Edge> ends;      // sample ids
  Array<int32_t> cell;   // a cell of the ring; infinite exactly when the dual facet is unbounded
  Array<int32_t> first;  // (n + 1) those from sample p are first[p] .. first[p + 1]

  int64_t count() const { return static_cast<int64_t>(ends.size()); }
};

// Cells, finite ones first, at each of the first `samples` points.
Csr<int32_t> incident_cells(const Triangulation& triangulation, int32_t samples, const Run& run);

// `row`: of each sample in the input. Those from one sample are in ascending order of the rows of
// their other ends.
Edges delaunay_edges(const Triangulation& triangulation, const Csr<int32_t>& incident,
                     std::span<const int32_t> row, const Run& run);

// kNext[i][j] = k so that the permutation (i, j, k, l) of (0, 1, 2, 3) is even.
inline constexpr int kNext[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};

// Calls visit(cell, slot) for the cells round an edge, counter-clockwise about the direction from
// ends[0] to ends[1], starting at `cell`; the next one lies across `slot`. Stops where visit
// returns false, and returns whether it never did.
template <typename Visit>
bool walk_ring(const Triangulation& t, const Edge& ends, int32_t cell, const Visit& visit) {
  const int i = slot_of(t.cells[cell], ends[0]), j = slot_of(t.cells[cell], ends[1]);
  int leave = kNext[i][j];
  int32_t keep = t.cells[cell][6 - i - j - leave];
  int32_t c = cell;
  do {
    if (!visit(c, leave)) return false;
    c = t.neighbors[c][leave];
    // Across the facet (ends, keep): next time `keep` is left behind, and the fourth corner kept.
    leave = slot_of(t.cells[c], keep);
    const Cell& ids = t.cells[c];
    keep = ids[0] + ids[1] + ids[2] + ids[3] - ends[0] - ends[1] - keep;
  } while (c != cell);
  return true;
}

// Writes the cells around an edge, which are the vertices of its Voronoi facet, to `ring`, which is
// cleared first.
void ring_of_cells(const Triangulation& triangulation, const Edge& ends, int32_t cell,
                   std::vector<int32_t>& ring);

// Per cell: whether its Voronoi vertex is one of the facets' dual to `edge_ids`.
std::vector<uint8_t> cells_round(std::span<const int32_t> edge_ids,
                                 const Triangulation& triangulation, const Edges& edges,
                                 const Run& run);

}  // namespace medial
