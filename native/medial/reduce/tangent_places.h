// SPDX-License-Identifier: GPL-3.0-or-later
// Places all over the surface of the solid of a sphere mesh, with normals: what a simpler mesh has
// to keep.
#pragma once

#include <vector>

#include "base/run.h"
#include "reduce/sphere_complex.h"

namespace medial {

// The plane there is tangent to a sphere (x, r) of the envelope where normal . x + r = normal .
// point.
struct TangentPlace {
  Vec3 point, normal;           // outward
  double area = 0;              // of the surface that it stands for
  std::array<int32_t, 3> of{};  // vertices of the slab, the cone or the ball; -1 behind them
};

// Both sides of slabs; round the rims of sheets and round wires all directions in between; of the
// balls what sticks out of all cones: caps at the ends of wires and at the corners of sheets.
std::vector<TangentPlace> tangent_places(const SphereMesh& mesh, const SphereComplex& complex,
                                         const Run& run);

}  // namespace medial
