// SPDX-License-Identifier: GPL-3.0-or-later
// The surface cut into pieces so small that curvature and spacing hardly change within one, and
// area-uniform places on them.
#pragma once

#include "sampling/pn_triangles.h"
#include "sampling/sizing.h"

namespace medial {

// Barycentric coordinates to the second and third corner.
struct Place {
  int32_t triangle;
  float b, c;

  Barycentric barycentric() const { return {std::max(0.0, 1.0 - b - c), b, c}; }
};

// A triangle, or one of its quarters, sixteenths, ...
struct Piece {
  int32_t triangle;
  uint32_t path;  // a leading 1, then two bits per cut: which quarter
  double area;
  double spacing;

  std::array<Barycentric, 3> corners() const;
};

// Cuts every triangle `cuts` times, and, where the spacing comes from a field, on while a piece is
// wider than two spacings. Pieces without area are left out; they come in the order of their
// triangles. Where there are more than `most`, they are not cut to the end: some more are returned.
std::vector<Piece> cut_into_pieces(const CurvedSurface& surface, int cuts, const Spacing& spacing,
                                   const Run& run, int64_t most = INT64_MAX);

// The k-th of `count` well spread places in a piece; `shift` in [0, 1)^2 moves them all.
Place place_in(const Piece& piece, const std::array<Barycentric, 3>& corners, int64_t k,
               const std::array<double, 2>& shift);

}  // namespace medial
