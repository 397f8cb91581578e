// SPDX-License-Identifier: GPL-3.0-or-later
// Collapses edges, the cheapest first, until few vertices are left.
#pragma once

#include <medial/sphere_mesh.h>

#include <span>

#include "base/run.h"
#include "reduce/tangent_places.h"

namespace medial {

// Holds the mesh after the collapse, and for each vertex its row if it has not moved, or -1. The
// given mesh must be checked, and in a unit near its extent; `places` are on its surface.
struct Collapsed {
  SphereMesh mesh;
  std::vector<int32_t> row;
};
Collapsed collapse_edges(const SphereMesh& mesh, SphereComplex complex,
                         std::span<const TangentPlace> places, int32_t wanted, const Run& run);

}  // namespace medial
