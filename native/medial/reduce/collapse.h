// SPDX-License-Identifier: GPL-3.0-or-later
// Collapses edges, the cheapest first, until few vertices are left.
#pragma once

#include <medial/sphere_mesh.h>

#include <optional>
#include <span>
#include <vector>

#include "base/run.h"
#include "reduce/sheet_locks.h"
#include "reduce/tangent_places.h"

namespace medial {

// Holds the mesh after the collapse, and for each vertex its row if it has not moved, or -1.
struct Collapsed {
  SphereMesh mesh;
  std::vector<int32_t> row;
  std::vector<int32_t> part;  // (t) only between sheets
};

// The given mesh must be checked, and in a unit near its extent; `places` are on its surface. With
// locks, edges collapse as reduce_sheets() says; there is no result if that needs more vertices.
std::optional<Collapsed> collapse_edges(const SphereMesh& mesh, SphereComplex complex,
                                        std::span<const TangentPlace> places, int32_t wanted,
                                        const Run& run, SheetLocks* locks = nullptr);

}  // namespace medial
