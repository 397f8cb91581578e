// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a list that are selected by their numbers, and the numbers that they get by it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace medial {

// Returns the numbers below `count` for which is_kept(number), ascending.
template <typename IsKept>
std::vector<int32_t> rows_where(int32_t count, const IsKept& is_kept) {
  std::vector<int32_t> kept;
  for (int32_t row = 0; row < count; ++row) {
    if (is_kept(row)) kept.push_back(row);
  }
  return kept;
}

template <typename List>
List rows_of(const List& values, std::span<const int32_t> rows) {
  List found;
  found.reserve(rows.size());
  for (const int32_t row : rows) found.push_back(values[row]);
  return found;
}

// Returns the place of each number below `count` among selected rows; -1 for those that are not.
inline std::vector<int32_t> places_among(std::span<const int32_t> rows, size_t count) {
  std::vector<int32_t> place(count, -1);
  for (size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<int32_t>(i);
  return place;
}

}  // namespace medial
