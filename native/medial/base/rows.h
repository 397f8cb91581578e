// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of coordinates made fit to compute with: finite, distinct, and in an order with spatial
// coherence.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/run.h"
#include "base/vec3.h"

namespace medial {

// Beyond these the fifth powers in a circumcentre would leave the range of a double.
inline constexpr double kSmallestExtent = 1e-50, kLargestCoordinate = 1e50;

// Throws InvalidInputError naming the first row with a coordinate that is not finite, or too large
// to be squared often.
void require_finite(std::span<const Vec3> rows, const char* what);

// The rows along a Hilbert curve; the order depends on the coordinates alone but for equal rows.
Array<int32_t> hilbert_order(std::span<const Vec3> rows, const Run& run);

struct DistinctRows {
  // (n) distinct points along a Hilbert curve.
  std::vector<Vec3> points;
  // (n) input row of each point: the first with its coordinates.
  std::vector<int32_t> row;
  // (rows) point of each input row.
  std::vector<int32_t> point_of_row;

  int32_t count() const { return static_cast<int32_t>(row.size()); }
};

// The distinct rows; their order depends on the coordinates alone, so that permuted rows give the
// same points. Throws InvalidInputError as require_finite does.
DistinctRows distinct_rows(std::span<const Vec3> rows, const char* what, const Run& run);

// The box of the rows.
Box box_of(std::span<const Vec3> rows);

}  // namespace medial
