// SPDX-License-Identifier: GPL-3.0-or-later
// Spreads places with normals over the whole surface of the solid of a sphere mesh; a simpler mesh
// has to keep this surface.
#pragma once

#include <vector>

#include "base/run.h"
#include "reduce/sphere_complex.h"

namespace medial {

// The plane at a place is tangent to a sphere (x, r) of the envelope if normal . x + r = normal .
// point.
struct TangentPlace {
  Vec3 point, normal;           // outward
  double area = 0;              // the part of the surface that it represents
  std::array<int32_t, 3> of{};  // vertices of the slab, the cone or the ball, followed by -1
};

// Returns places on both sides of slabs, in all directions between them around the rims of sheets
// and around wires, and on the parts of balls that stick out of all cones: caps at the ends of
// wires and at the corners of sheets.
std::vector<TangentPlace> tangent_places(const SphereMesh& mesh, const SphereComplex& complex,
                                         const Run& run);

}  // namespace medial
