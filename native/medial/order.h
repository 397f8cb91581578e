// Sorting rows of ids.
#pragma once

#include <algorithm>
#include <numeric>

#include "csr.h"
#include "parallel.h"

namespace medial {

// The rows of a table in lexicographic order; first entries lie in [0, ids). A counting sort by the
// first entry, then each group by itself.
template <typename Row>
std::vector<int32_t> lexicographic_order(std::span<const Row> table, size_t ids, const Run& run) {
  std::vector<int64_t> start(ids + 1, 0);
  for (const Row& row : table) ++start[row[0]];
  counts_to_offsets(start);
  std::vector<int32_t> order(table.size());
  auto next = start;
  for (int32_t i = 0; i < static_cast<int32_t>(order.size()); ++i) order[next[table[i][0]]++] = i;
  parallel_for(static_cast<int64_t>(ids), run, [&](int64_t id) {
    std::sort(order.begin() + start[id], order.begin() + start[id + 1],
              [&](int32_t a, int32_t b) { return table[a] < table[b]; });
  });
  return order;
}

// Puts values into an order.
template <typename T>
void reorder(std::vector<T>& values, std::span<const int32_t> order, const Run& run) {
  std::vector<T> sorted(values.size());
  parallel_for(static_cast<int64_t>(order.size()), run,
               [&](int64_t i) { sorted[i] = values[order[i]]; });
  values = std::move(sorted);
}

}  // namespace medial
