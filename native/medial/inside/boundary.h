// SPDX-License-Identifier: GPL-3.0-or-later
// Finds where a triangle soup is not closed.
#pragma once

#include <span>
#include <vector>

#include "base/csr.h"
#include "base/triangle.h"

namespace medial {

// Returns the boundary of the triangles: the directed edges that they use more often than their
// opposites, once per surplus use. If it is empty, the triangles are closed, and the winding number
// is an integer off the surface. `fans` lists the triangles at each vertex.
std::vector<Edge> boundary_edges(std::span<const Triangle> triangles, const Csr<int32_t>& fans,
                                 const Run& run);

}  // namespace medial
