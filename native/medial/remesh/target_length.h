// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses how long the edges of an even mesh shall be at each vertex.
#pragma once

#include "base/run.h"
#include "remesh/even_mesh.h"

namespace medial {

// Lowers values to at most that of any other vertex plus `slope` times the way to it along edges.
void spread_least(const SheetComplex& mesh, std::span<const Vec3> position, double slope,
                  std::vector<double>& values);

// Returns for each vertex half the width of the sheet there: how far the farthest vertices that are
// nearest to the same place of a seam or rim are from it.
std::vector<double> half_widths(const SheetComplex& mesh, std::span<const Vec3> position);

// Returns for each vertex the largest curvature of its sheet, by the turns at all of its edges
// (Cohen-Steiner and Morvan 2003), so that noise that turns the sheet both ways evens out. It is 0
// at seams and nodes.
std::vector<double> curvatures(const EvenMesh& even, const Run& run);

}  // namespace medial
