// SPDX-License-Identifier: GPL-3.0-or-later
// Ids are sorted by a counting sort into buckets on all threads, then by small sorts within the
// buckets.
#pragma once

#include <algorithm>

#include "base/atomic.h"
#include "base/csr.h"
#include "base/parallel.h"

namespace medial {

// Sorts 0, ..., count - 1 by bucket_of(id) in [0, buckets), then by key_of(id), then by the ids
// themselves, and calls placed(position, id) for each.
template <typename BucketOf, typename KeyOf, typename Placed>
void bucket_sort(int64_t count, size_t buckets, const Run& run, const BucketOf& bucket_of,
                 const KeyOf& key_of, const Placed& placed) {
  auto next = array<int32_t>(buckets + 1, 0, run);
  const auto place = [&](int64_t id) { return shared_add(next[bucket_of(id)], 1); };
  parallel_for(count, run, place);
  counts_to_offsets(next);
  // The keys lie with the ids, for looking them up bucket by bucket would wait for memory.
  using Keyed = std::pair<decltype(key_of(0)), int32_t>;
  auto sorted = array<Keyed>(static_cast<size_t>(count), run);
  parallel_for(count, run, [&](int64_t id) {
    sorted[place(id)] = {key_of(id), static_cast<int32_t>(id)};
  });
  // Now next[b] is the end of bucket b.
  parallel_for(static_cast<int64_t>(buckets), run, [&](int64_t b) {
    const int32_t begin = b == 0 ? 0 : next[b - 1], end = next[b];
    std::sort(sorted.begin() + begin, sorted.begin() + end);
    for (int32_t i = begin; i < end; ++i) placed(i, sorted[i].second);
  });
}

// Does the same, and returns a list of the ids.
template <typename BucketOf, typename KeyOf>
Array<int32_t> bucket_order(int64_t count, size_t buckets, const Run& run,
                            const BucketOf& bucket_of, const KeyOf& key_of) {
  auto order = array<int32_t>(static_cast<size_t>(count), run);
  bucket_sort(count, buckets, run, bucket_of, key_of,
              [&](int32_t position, int32_t id) { order[position] = id; });
  return order;
}

// Sorts the rows of a table in lexicographic order, ties by id. The first entries must be in [0,
// ids).
template <typename Row>
Array<int32_t> lexicographic_order(std::span<const Row> table, size_t ids, const Run& run) {
  return bucket_order(
      static_cast<int64_t>(table.size()), ids, run, [&](int64_t i) { return table[i][0]; },
      [&](int64_t i) { return table[i]; });
}

// Permutes values into an order.
template <typename T>
void reorder(std::vector<T>& values, std::span<const int32_t> order, const Run& run) {
  std::vector<T> sorted(values.size());
  parallel_for(static_cast<int64_t>(order.size()), run,
               [&](int64_t i) { sorted[i] = values[order[i]]; });
  values = std::move(sorted);
}

}  // namespace medial
