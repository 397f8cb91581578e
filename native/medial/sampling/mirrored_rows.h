// SPDX-License-Identifier: GPL-3.0-or-later
// Makes pairs of places that mirror each other in a sharp edge, so that the medial axis meets the
// edge in a line as straight as the edge: the bisector of the sides is equally far from both
// places.
#pragma once

#include <optional>

#include "sampling/poisson_disk.h"

namespace medial {

// Walks from the place `share` of the way along an edge of a triangle, at a right angle into the
// triangle, and straight on over the edges that follow. Returns nothing if a crease comes first.
std::optional<SurfacePlace> walk_from_edge(const TriangleMesh& mesh, const Creases& creases,
                                           const MeshEdge& edge, int32_t triangle, double share,
                                           double distance);

// Returns the ids of the pairs that have room, ascending: neither place is inside a disc, either
// fixed or of another pair, as in poisson_disks. If two pairs are in each other's way, none stays,
// so the order of the edges does not matter.
std::vector<int32_t> free_pairs(std::span<const Disk> fixed,
                                std::span<const std::array<Disk, 2>> pairs, const Run& run);

}  // namespace medial
