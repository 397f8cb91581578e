// Sorting ids: a counting sort into buckets by all threads, then small sorts within the buckets.
#pragma once

#include <algorithm>

#include "csr.h"
#include "parallel.h"

namespace medial {

// 0, ..., count - 1 by ascending bucket_of(id) in [0, buckets), then by `before`, which must tell
// all ids of a bucket apart.
template <typename BucketOf, typename Before>
Array<int32_t> bucket_order(int64_t count, size_t buckets, const Run& run,
                            const BucketOf& bucket_of, const Before& before) {
  auto next = array<int32_t>(buckets + 1, 0, run);
  const auto place = [&](int64_t id) {
    return std::atomic_ref(next[bucket_of(id)]).fetch_add(1, std::memory_order_relaxed);
  };
  parallel_for(count, run, place);
  counts_to_offsets(next);
  auto order = array<int32_t>(static_cast<size_t>(count), run);
  parallel_for(count, run, [&](int64_t id) { order[place(id)] = static_cast<int32_t>(id); });
  // Now next[b] is the end of bucket b.
  parallel_for(static_cast<int64_t>(buckets), run, [&](int64_t b) {
    std::sort(order.begin() + (b == 0 ? 0 : next[b - 1]), order.begin() + next[b], before);
  });
  return order;
}

// The rows of a table in lexicographic order, equal ones by their ids; first entries lie in [0,
// ids).
template <typename Row>
Array<int32_t> lexicographic_order(std::span<const Row> table, size_t ids, const Run& run) {
  return bucket_order(
      static_cast<int64_t>(table.size()), ids, run, [&](int64_t i) { return table[i][0]; },
      [&](int32_t a, int32_t b) { return table[a] < table[b] || (table[a] == table[b] && a < b); });
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
