// Where a triangle soup is not closed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "csr.h"
#include "parallel.h"

namespace medial {

using Triangle = std::array<int32_t, 3>;
using Edge = std::array<int32_t, 2>;

// Next and previous corner of a triangle seen from corner `id`.
Edge link_of(const Triangle& triangle, int32_t id);

// The directed edges that the triangles use more often than their opposites, once per surplus use:
// the boundary of the chain of triangles. Empty: closed, and the winding number is an integer off
// the surface. `fans` lists the triangles at each vertex.
std::vector<Edge> boundary_edges(std::span<const Triangle> triangles, const Csr<int32_t>& fans,
                                 const Run& run);

}  // namespace medial
