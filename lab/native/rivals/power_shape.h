// SPDX-License-Identifier: GPL-3.0-or-later
// The power shape (Amenta, Choi & Kolluri 2001) shows where the power cells of balls meet.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <span>

namespace medial {

// These are the simplices of the regular triangulation of balls all of whose corners are wanted.
struct PowerShape {
  Column<Triangle> triangles;  // rows of three balls whose cells meet, ascending, in order
  Column<Edge> edges;          // of two balls that are in no such triangle, likewise
  Column<int32_t> balls;       // rows, ascending, of those that have a cell
};

// Returns the simplices of the regular triangulation of all balls whose corners are wanted. `radii`
// and `wanted` have one entry per centre. Throws InvalidInputError, Cancelled.
PowerShape power_shape(std::span<const Vec3> centres, std::span<const double> radii,
                       std::span<const uint8_t> wanted, Progress* progress = nullptr);

}  // namespace medial
