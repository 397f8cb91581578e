#include "complex.h"

namespace medial {
namespace {

struct HalfEdge {
  int32_t low, high, cell;
};

// kNext[i][j] = k so that the permutation (i, j, k, l) of (0, 1, 2, 3) is even.
constexpr int kNext[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};

}  // namespace

Csr<int32_t> incident_cells(const Triangulation& t, int32_t samples, const Run& run) {
  return rows_containing(std::span<const Cell>(t.cells), samples, run.progress);
}

Edges delaunay_edges(const Triangulation& t, const Csr<int32_t>& incident, const Run& run) {
  const auto samples = static_cast<int32_t>(incident.size());
  std::vector<std::vector<int32_t>> seen_by(run.threads);
  const auto found = parallel_append<HalfEdge>(
      samples, run, [&](int64_t id, std::vector<HalfEdge>& out, int worker) {
        auto& seen = seen_by[worker];
        if (seen.empty()) seen.assign(static_cast<size_t>(samples), -1);
        const auto p = static_cast<int32_t>(id);
        const auto cells = incident[p];
        // Backwards: infinite cells come first, so that an unbounded facet is known by its cell.
        for (auto cell = cells.rbegin(); cell != cells.rend(); ++cell) {
          for (const int32_t q : t.cells[*cell]) {
            if (q > p && q < samples && seen[q] != p) {
              seen[q] = p;
              out.push_back({p, q, *cell});
            }
          }
        }
      });
  Edges edges;
  edges.ends.resize(found.size());
  edges.cell.resize(found.size());
  parallel_for(static_cast<int64_t>(found.size()), run, [&](int64_t e) {
    edges.ends[e] = {found[e].low, found[e].high};
    edges.cell[e] = found[e].cell;
  });
  return edges;
}

void ring_of_cells(const Triangulation& t, const Edge& ends, int32_t cell,
                   std::vector<int32_t>& ring) {
  ring.clear();
  const int i = slot_of(t.cells[cell], ends[0]), j = slot_of(t.cells[cell], ends[1]);
  int leave = kNext[i][j];
  int32_t keep = t.cells[cell][6 - i - j - leave];
  int32_t c = cell;
  do {
    ring.push_back(c);
    c = t.neighbors[c][leave];
    // Across the facet (ends, keep): next time `keep` is left behind, and the fourth corner kept.
    leave = slot_of(t.cells[c], keep);
    const Cell& ids = t.cells[c];
    keep = ids[0] + ids[1] + ids[2] + ids[3] - ends[0] - ends[1] - keep;
  } while (c != cell);
}

}  // namespace medial
