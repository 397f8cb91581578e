// SPDX-License-Identifier: GPL-3.0-or-later
// These functions prepare rows of coordinates for computation: finite, distinct, and in a spatially
// coherent order; and select rows of any list.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "base/run.h"
#include "base/vec3.h"

namespace medial {

// Beyond these limits the fifth powers in a circumcentre would overflow or underflow a double.
inline constexpr double kSmallestExtent = 1e-50, kLargestCoordinate = 1e50;  // derived: 1e308^(1/6)

// Throws InvalidInputError naming the first row with a coordinate that is not finite, or beyond the
// limit.
void require_finite(std::span<const Vec3> rows, const char* what);

// Sorts the rows along a Hilbert curve. The order depends only on the coordinates, except among
// equal rows.
Array<int32_t> hilbert_order(std::span<const Vec3> rows, const Run& run);

struct DistinctRows {
  // These are the (n) distinct points along a Hilbert curve.
  std::vector<Vec3> points;
  // The (n) input row of each point is the first with its coordinates.
  std::vector<int32_t> row;
  // This is the point of each of the (rows) input rows.
  std::vector<int32_t> point_of_row;

  int32_t count() const { return static_cast<int32_t>(row.size()); }
};

// Returns the distinct rows. Their order depends only on the coordinates, so permuted rows give the
// same points. Throws InvalidInputError as require_finite does.
DistinctRows distinct_rows(std::span<const Vec3> rows, const char* what, const Run& run);

// Returns the bounding box of the rows.
Box box_of(std::span<const Vec3> rows);

// Returns the numbers below `count`, ascending.
inline std::vector<int32_t> all_rows(size_t count) {
  std::vector<int32_t> rows(count);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

// Returns the numbers below `count` for which is_kept(number), ascending.
template <typename IsKept>
std::vector<int32_t> rows_where(size_t count, const IsKept& is_kept) {
  std::vector<int32_t> kept;
  for (int32_t row = 0; row < static_cast<int32_t>(count); ++row) {
    if (is_kept(row)) kept.push_back(row);
  }
  return kept;
}

// Returns selected rows of a list, as a list of the same kind.
template <typename List, typename Found = List>
Found rows_of(const List& values, std::span<const int32_t> rows) {
  Found found;
  found.reserve(rows.size());
  for (const int32_t row : rows) found.push_back(values[row]);
  return found;
}
template <typename T>
std::vector<T> rows_of(std::span<const T> values, std::span<const int32_t> rows) {
  return rows_of<std::span<const T>, std::vector<T>>(values, rows);
}

// Returns the place of each number below `count` among selected rows; -1 for those that are not.
inline std::vector<int32_t> places_among(std::span<const int32_t> rows, size_t count) {
  std::vector<int32_t> place(count, -1);
  for (size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<int32_t>(i);
  return place;
}

}  // namespace medial
