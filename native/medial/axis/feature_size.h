// SPDX-License-Identifier: GPL-3.0-or-later
// The local feature size at the samples: their distance to the medial axis (Dey & Zhao, sect. 2).
#pragma once

#include "delaunay/edges.h"
#include "delaunay/voronoi.h"

namespace medial {

// Distance of the points `at` to the nearest finite vertex of the facets dual to `edge_ids`,
// infinite when there is none. Of vertices much closer to each other than to the samples some are
// left out, which makes it too large by at most kThinning of itself.
std::vector<double> feature_size(std::span<const Vec3> points, std::span<const int32_t> at,
                                 const Triangulation& triangulation, const Voronoi& voronoi,
                                 const Edges& edges, std::span<const int32_t> edge_ids,
                                 const Run& run);

inline constexpr double kThinning = 1.0 / 32;

}  // namespace medial
