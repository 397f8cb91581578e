// SPDX-License-Identifier: GPL-3.0-or-later
// Values of some samples carried to the others along the surface.
#pragma once

#include "axis/significance.h"
#include "axis/tangent_balls.h"

namespace medial {

// Gives each sample with an infinite value that of the nearest sample with a finite one, along the
// short Delaunay edges between samples that do not face away from each other: such edges follow the
// surface and cross neither walls nor gaps. Samples that no path leads to keep theirs.
void extrapolate(std::vector<double>& values, std::span<const Vec3> points,
                 const Tangents& tangents, const Edges& edges, const Significance& significance,
                 const Run& run);

}  // namespace medial
