// SPDX-License-Identifier: GPL-3.0-or-later
// Smooths jagged rims: vertices on the rim of a sheet move towards the middle of their neighbours
// on it. Facets keep their corners, and none folds.
#pragma once

#include <span>
#include <vector>

#include "base/run.h"
#include "base/vec3.h"

namespace medial {

// Holds the corners of polygons: facet i has the corners [offsets[i], offsets[i + 1]).
struct Polygons {
  std::span<const int32_t> offsets, corners;
};

// Moves the vertices with exactly two of the rim edges; returns these vertices, ascending.
std::vector<int32_t> relax_rims(const Polygons& polygons, std::span<const Edge> rims,
                                std::span<Vec3> places, const Run& run);

// Takes waves that are short against the rim out of it. The vertices of some rings inside move with
// it, in the sheet, for a notch is deeper than a facet. Seams stay, and the vertices that are
// `pinned` (0 or 1 per vertex) if they are no vertices of the given rims. No facet folds, seen
// along `across` (per facet, either way round).
std::vector<int32_t> relax_rim_bands(const Polygons& polygons, std::span<const Edge> rims,
                                     std::span<const uint8_t> pinned, std::span<const Vec3> across,
                                     std::span<Vec3> places, const Run& run);

}  // namespace medial
