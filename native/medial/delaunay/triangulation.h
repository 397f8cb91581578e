// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the Delaunay triangulation D_P as plain arrays.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/vec3.h"

namespace medial {

inline constexpr int32_t kInfinite = -1;

using Cell = std::array<int32_t, 4>;

// Returns the place of an id in a row of four that contains it.
// The function does not branch, because all places are equally likely.
inline int slot_of(const Cell& row, int32_t id) {
  return (row[1] == id) + 2 * (row[2] == id) + 3 * (row[3] == id);
}

// Cells are positively oriented (an infinite cell as if the infinite vertex were outside the hull)
// and start with their lowest id. Finite cells come first; each part is in lexicographic order of
// the sorted ids, so the arrays do not depend on how the triangulation was built.
struct Triangulation {
  Array<Cell> cells;      // point ids, kInfinite for the infinite vertex
  Array<Cell> neighbors;  // neighbors[c][i]: the cell across the facet opposite to cells[c][i]
  int32_t finite_cells = 0;

  int32_t cell_count() const { return static_cast<int32_t>(cells.size()); }
  bool is_infinite(int32_t cell) const { return cell >= finite_cells; }
};

// Throws DegenerateInputError if all points are in one place, on one line or in one plane; the test
// is exact.
void require_volume(std::span<const Vec3> points);

// Triangulates points, which must be distinct, must span a volume and should be in spatial order.
// CGAL's symbolic perturbation, which depends only on coordinates, triangulates cospherical points.
// `watch` gets the lap "triangulation" when CGAL is done, before the copy into arrays.
Triangulation triangulate(std::span<const Vec3> points, const Run& run, Stopwatch* watch = nullptr);

}  // namespace medial
