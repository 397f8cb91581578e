// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses how long the edges of an even mesh shall be at each vertex.
#pragma once

#include "base/vec3.h"
#include "remesh/sheet_complex.h"

namespace medial {

// Lowers values to at most that of any other vertex plus `slope` times the way to it along edges.
void spread_least(const SheetComplex& mesh, std::span<const Vec3> position, double slope,
                  std::vector<double>& values);

// Returns for each vertex half the width of the sheet there: how far the farthest vertices that are
// nearest to the same place of a seam or rim are from it.
std::vector<double> half_widths(const SheetComplex& mesh, std::span<const Vec3> position);

}  // namespace medial
