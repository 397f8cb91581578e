// SPDX-License-Identifier: GPL-3.0-or-later
// Edges collapse, cheapest first, until few vertices are left.
#pragma once

#include <medial/sphere_mesh.h>

#include <span>

#include "base/run.h"
#include "reduce/tangent_places.h"

namespace medial {

// A mesh that is checked, in a unit near its extent. `places` are those of its surface. With it go
// the rows of the vertices that have not moved; -1: moved.
struct Collapsed {
  SphereMesh mesh;
  std::vector<int32_t> row;
};
Collapsed collapse_edges(const SphereMesh& mesh, SphereComplex complex,
                         std::span<const TangentPlace> places, int32_t wanted, const Run& run);

}  // namespace medial
