// SPDX-License-Identifier: GPL-3.0-or-later
// The local feature size of a sample is its distance to the medial axis (Dey & Zhao, sect. 2).
#pragma once

#include "delaunay/edges.h"
#include "delaunay/voronoi.h"

namespace medial {

// Returns the distance of the points `at` to the nearest finite vertex of the facets dual to
// `edge_ids`, or infinity if there is none. Vertices much closer to each other than to the samples
// are thinned, so the distance is too large by at most the share kThinning.
std::vector<double> feature_size(std::span<const Vec3> points, std::span<const int32_t> at,
                                 const Triangulation& triangulation, const Voronoi& voronoi,
                                 const Edges& edges, std::span<const int32_t> edge_ids,
                                 const Run& run);

inline constexpr double kThinning = 1.0 / 32;  // chosen: skeleton

}  // namespace medial
