// SPDX-License-Identifier: GPL-3.0-or-later
// A Csr keeps lists of different lengths in one array: list i is items[offsets[i] .. offsets[i +
// 1]).
#pragma once

#include <array>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "base/parallel.h"

namespace medial {

template <typename T>
struct Csr {
  Array<int64_t> offsets;  // (lists + 1)
  Array<T> items;

  int64_t size() const { return static_cast<int64_t>(offsets.size()) - 1; }
  std::span<const T> operator[](int64_t i) const {
    const auto begin = static_cast<size_t>(offsets[i]);
    return {items.data() + begin, static_cast<size_t>(offsets[i + 1]) - begin};
  }
};

// Turns counts[i], the length of list i, into offsets; counts has one extra last entry, whatever
// its value.
template <typename Counts>
void counts_to_offsets(Counts&& counts) {
  std::ranges::range_value_t<Counts> sum = 0;
  for (auto& count : counts) {
    const auto length = count;
    count = sum;
    sum += length;
  }
}

// Lists the second numbers of pairs by the first ones, which are below `lists`. The pairs are
// sorted.
inline Csr<int32_t> csr_of_pairs(std::span<const std::array<int32_t, 2>> pairs, size_t lists,
                                 const Run& run) {
  Csr<int32_t> result{array<int64_t>(lists + 1, 0, run), array<int32_t>(pairs.size(), run)};
  for (size_t i = 0; i < pairs.size(); ++i) {
    ++result.offsets[pairs[i][0]];
    result.items[i] = pairs[i][1];
  }
  counts_to_offsets(result.offsets);
  return result;
}

// Inverts a table: list k holds, ascending, the rows that contain k. Ids outside [0, lists) are
// skipped. Each thread reads the whole table for some of the lists.
template <typename Row>
Csr<int32_t> rows_containing(std::span<const Row> table, int32_t lists, const Run& run = {}) {
  const auto parts = std::min<int64_t>(run.threads, lists);
  // Calls found(i, k) for the rows i that contain k, for all k.
  const auto for_all = [&](const auto& found) {
    parallel_for(
        parts, run,
        [&](int64_t part) {
          const auto low = static_cast<int32_t>(lists * part / parts);
          const auto high = static_cast<int32_t>(lists * (part + 1) / parts);
          for (size_t i = 0; i < table.size(); ++i) {
            for (const int32_t k : table[i]) {
              if (k >= low && k < high) found(static_cast<int32_t>(i), k);
            }
          }
        },
        1);
  };
  Csr<int32_t> result;
  result.offsets = array<int64_t>(static_cast<size_t>(lists) + 2, 0, run);
  // The starts are shifted by one: filling a list moves its start to its end, which leaves the
  // offsets.
  int64_t* const start = result.offsets.data() + 1;
  for_all([&](int32_t, int32_t k) { ++start[k]; });
  counts_to_offsets(std::span(result.offsets).subspan(1));
  result.items = array<int32_t>(static_cast<size_t>(result.offsets.back()), run);
  for_all([&](int32_t i, int32_t k) { result.items[static_cast<size_t>(start[k]++)] = i; });
  result.offsets.pop_back();
  return result;
}

}  // namespace medial
