// SPDX-License-Identifier: GPL-3.0-or-later
// These functions prepare rows of coordinates for computation: finite, distinct, and in a spatially
// coherent order.
#pragma once

#include <cstdint>
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

}  // namespace medial
