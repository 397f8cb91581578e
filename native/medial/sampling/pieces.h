// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts the surface into pieces so small that curvature and spacing hardly change in one, and
// spreads places on them uniformly by area.
#pragma once

#include "sampling/pn_triangles.h"
#include "sampling/sizing.h"

namespace medial {

// Holds the barycentric coordinates of the second and the third corner.
struct Place {
  int32_t triangle;
  float b, c;

  Barycentric barycentric() const { return {std::max(0.0, 1.0 - b - c), b, c}; }
};

// A piece is a triangle, or one of its quarters, sixteenths, ...
struct Piece {
  int32_t triangle;
  uint32_t path;  // a leading 1, then two bits per cut for the quarter
  double area;
  double spacing;

  std::array<Barycentric, 3> corners() const;
};

// Cuts every triangle `cuts` times. If the spacing comes from a field, a piece is cut further while
// it is wider than two spacings. Pieces without area are omitted; they are in the order of their
// triangles. If there are more than `most`, cutting stops early, and somewhat more than `most` are
// returned.
std::vector<Piece> cut_into_pieces(const CurvedSurface& surface, int cuts, const Spacing& spacing,
                                   const Run& run, int64_t most = INT64_MAX);

// Returns the k-th of `count` well spread places in a piece; `shift` in [0, 1)^2 moves all of them.
Place place_in(const Piece& piece, const std::array<Barycentric, 3>& corners, int64_t k,
               const std::array<double, 2>& shift);

}  // namespace medial
