// SPDX-License-Identifier: GPL-3.0-or-later
// This computes umbrellas (Dey & Zhao, Definition 3).
#pragma once

#include "axis/poles.h"

namespace medial {

// List p is the umbrella U_p: its triangles (p, a, b) as pairs (a, b). Their dual Voronoi edges,
// segments or rays, cross the plane through p normal to the pole vector.
using Umbrellas = Csr<std::array<int32_t, 2>>;

Umbrellas umbrellas(std::span<const Vec3> points, const Triangulation& triangulation,
                    const Voronoi& voronoi, const Csr<int32_t>& incident, const Run& run);

}  // namespace medial
