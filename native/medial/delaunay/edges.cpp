// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/edges.h"

#include <algorithm>
#include <optional>

#include "base/atomic.h"

namespace medial {
namespace {

// Leads along an edge to another sample; `cell` is a cell at the edge.
struct Way {
  int32_t to, cell;
};

// Finds the edges from a sample to samples of higher rows.
class Ways {
 public:
  Ways(const Triangulation& triangulation, const Csr<int32_t>& incident,
       std::span<const int32_t> row)
      : t_(triangulation), incident_(incident), row_(row), seen_(row.size(), 0) {}

  // Appends these edges in ascending order of the rows; returns their number.
  int32_t append(int32_t p, std::vector<Way>& out) {
    const size_t count = find(p);
    order_.clear();
    for (size_t i = 0; i < count; ++i) {
      order_.push_back(static_cast<uint64_t>(row_[ways_[i].to]) << 32 | i);
    }
    std::sort(order_.begin(), order_.end());
    for (const uint64_t next : order_) out.push_back(ways_[next & 0xffffffffu]);
    return static_cast<int32_t>(count);
  }

 private:
  // Fills the front of `ways_`; returns the number of entries. Every corner is written there, but
  // counted only if it is new and has a higher row; a branch instead would often be mispredicted.
  size_t find(int32_t p) {
    const auto cells = incident_[p];
    if (ways_.size() < 4 * cells.size()) ways_.resize(4 * cells.size());
    ++call_;
    size_t count = 0;
    // The loop runs backwards, so infinite cells come first and an unbounded facet gets an infinite
    // cell.
    for (auto cell = cells.rbegin(); cell != cells.rend(); ++cell) {
      for (const int32_t q : t_.cells[*cell]) {
        if (static_cast<uint32_t>(q) >= seen_.size()) continue;
        ways_[count] = {q, *cell};
        count += static_cast<size_t>(int{seen_[q] != call_} & int{row_[q] > row_[p]});
        seen_[q] = call_;
      }
    }
    return count;
  }

  const Triangulation& t_;
  const Csr<int32_t>& incident_;
  std::span<const int32_t> row_;
  uint32_t call_ = 0;
  std::vector<uint32_t> seen_;  // per sample: the last call that visited it
  std::vector<Way> ways_;
  std::vector<uint64_t> order_;
};

}  // namespace

Csr<int32_t> incident_cells(const Triangulation& t, int32_t samples, const Run& run) {
  return rows_containing(std::span<const Cell>(t.cells), samples, run);
}

Edges delaunay_edges(const Triangulation& t, const Csr<int32_t>& incident,
                     std::span<const int32_t> row, const Run& run) {
  std::vector<std::optional<Ways>> ways(run.threads);
  Edges edges;
  edges.first = array<int32_t>(row.size() + 1, 0, run);
  const auto parts =
      parallel_parts<Way>(incident.size(), run, [&](int64_t p, auto& out, int worker) {
        if (!ways[worker]) ways[worker].emplace(t, incident, row);
        edges.first[p] = ways[worker]->append(static_cast<int32_t>(p), out);
      });
  counts_to_offsets(edges.first);
  edges.ends = array<Edge>(static_cast<size_t>(edges.first.back()), run);
  edges.cell = array<int32_t>(static_cast<size_t>(edges.first.back()), run);
  parallel_chunks(incident.size(), run, [&](int64_t begin, int64_t end, int) {
    auto way = parts[static_cast<size_t>(begin / kGrain)].begin();
    for (int64_t p = begin; p < end; ++p) {
      for (int32_t e = edges.first[p]; e < edges.first[p + 1]; ++e, ++way) {
        edges.ends[e] = {static_cast<int32_t>(p), way->to};
        edges.cell[e] = way->cell;
      }
    }
  });
  return edges;
}

void ring_of_cells(const Triangulation& t, const Edge& ends, int32_t cell,
                   std::vector<int32_t>& ring) {
  ring.clear();
  walk_ring(t, ends, cell, [&](int32_t c, int) {
    ring.push_back(c);
    return true;
  });
}

std::vector<uint8_t> cells_round(std::span<const int32_t> edge_ids, const Triangulation& t,
                                 const Edges& edges, const Run& run) {
  std::vector<uint8_t> marked(t.cells.size(), 0);
  parallel_chunks(static_cast<int64_t>(edge_ids.size()), run, [&](int64_t begin, int64_t end, int) {
    std::vector<int32_t> ring;
    for (int64_t i = begin; i < end; ++i) {
      ring_of_cells(t, edges.ends[edge_ids[i]], edges.cell[edge_ids[i]], ring);
      for (const int32_t cell : ring) shared_store(marked[cell], uint8_t{1});
    }
  });
  return marked;
}

}  // namespace medial
