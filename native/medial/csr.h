// Lists of different lengths in one array: list i is items[offsets[i] .. offsets[i + 1]).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "progress.h"

namespace medial {

template <typename T>
struct Csr {
  std::vector<int64_t> offsets;  // (lists + 1)
  std::vector<T> items;

  int64_t size() const { return static_cast<int64_t>(offsets.size()) - 1; }
  std::span<const T> operator[](int64_t i) const {
    const auto begin = static_cast<size_t>(offsets[i]);
    return {items.data() + begin, static_cast<size_t>(offsets[i + 1]) - begin};
  }
};

// Turns counts[i], the length of list i, into offsets; counts has one extra last entry, whatever
// its value.
inline void counts_to_offsets(std::span<int64_t> counts) {
  int64_t sum = 0;
  for (auto& count : counts) {
    const int64_t length = count;
    count = sum;
    sum += length;
  }
}

// Inverts a table: list k holds, ascending, the rows that contain k. Ids outside [0, lists) are
// passed over.
template <typename Row>
Csr<int32_t> rows_containing(std::span<const Row> table, int32_t lists,
                             const Progress* progress = nullptr) {
  constexpr int32_t kBatch = 1 << 18;
  Csr<int32_t> result;
  result.offsets.assign(static_cast<size_t>(lists) + 2, 0);
  int64_t* const start =
      result.offsets.data() + 1;  // shifted by one: ends as the offsets themselves
  for (int32_t i = 0; i < static_cast<int32_t>(table.size()); ++i) {
    if (i % kBatch == 0) throw_if_cancelled(progress);
    for (const int32_t k : table[static_cast<size_t>(i)]) {
      if (k >= 0 && k < lists) ++start[k];
    }
  }
  counts_to_offsets(std::span(result.offsets).subspan(1));
  result.items.resize(static_cast<size_t>(result.offsets.back()));
  for (int32_t i = 0; i < static_cast<int32_t>(table.size()); ++i) {
    if (i % kBatch == 0) throw_if_cancelled(progress);
    for (const int32_t k : table[static_cast<size_t>(i)]) {
      if (k >= 0 && k < lists) result.items[static_cast<size_t>(start[k]++)] = i;
    }
  }
  result.offsets.pop_back();
  return result;
}

}  // namespace medial
