// SPDX-License-Identifier: GPL-3.0-or-later
// Umbrellas (Dey & Zhao, Definition 3).
#pragma once

#include "axis/poles.h"

namespace medial {

// U_p: the triangles (p, a, b) of list p, as the pairs (a, b). They are the triangles whose dual
// Voronoi edge, segment or ray, crosses the plane through p normal to the pole vector.
using Umbrellas = Csr<std::array<int32_t, 2>>;

Umbrellas umbrellas(std::span<const Vec3> points, const Triangulation& triangulation,
                    const Voronoi& voronoi, const Csr<int32_t>& incident, const Run& run);

}  // namespace medial
