// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of places that mirror each other in a sharp edge, so that the medial axis runs into the
// edge as straight as the edge itself: what is equally far from both is the bisector of the sides.
#pragma once

#include <optional>

#include "sampling/poisson_disk.h"

namespace medial {

struct SurfacePlace {
  int32_t triangle;
  Barycentric at;
};

// From the place `share` of the way along an edge of a triangle, at a right angle into the triangle
// and straight on over the edges that follow. Nothing when a crease comes first.
std::optional<SurfacePlace> walk_from_edge(const TriangleMesh& mesh, const Creases& creases,
                                           const MeshEdge& edge, int32_t triangle, double share,
                                           double distance);

// Ids of the pairs that have room, ascending: where neither is inside a disc, be it fixed or of
// another pair, as for poisson_disks. Of two pairs in each other's way none stays, so that the
// order of the edges does not matter.
std::vector<int32_t> free_pairs(std::span<const Disk> fixed,
                                std::span<const std::array<Disk, 2>> pairs, const Run& run);

}  // namespace medial
