// SPDX-License-Identifier: GPL-3.0-or-later
// The line in which the sheet beside a fillet ends: a chain of knots, straight between them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/run.h"
#include "base/vec3.h"

namespace medial {

// A place between two knots; both are the same at a knot.
struct OnLine {
  Edge knots{-1, -1};
  double share = 0;  // of the way from the first one to the second one

  bool is_at_knot() const { return knots[0] == knots[1]; }
};

// Moves each of some places onto the line through those around it; the few that are far off this
// line have none. `spacing` is per place.
std::vector<std::optional<Vec3>> straightened(std::span<const Vec3> places,
                                              std::span<const double> spacing, const Run& run);

// Draws together what more than one edge of a rim covers, so that at most one edge covers each part
// of the line; new knots are added. `at` is the place on the line of each vertex, `web` are the
// vertices that have one, and `rims` are edges between these. What was between two knots still is.
void cover_once(std::vector<Vec3>& knots, std::span<const Edge> rims, std::span<const int32_t> web,
                std::span<OnLine> at);

}  // namespace medial
