// SPDX-License-Identifier: GPL-3.0-or-later
// The faces on which the samples of an analysis lie. A hierarchy takes exact places from them.
#pragma once

#include <medial/types.h>

#include <span>

namespace medial {

// Rows of `vertices` and `triangles` are as in sample_surface, and so are the options.
struct FacesInput {
  std::span<const Vec3> vertices;
  std::span<const Triangle> triangles;       // outward
  std::span<const int32_t> face;             // per point of the analysis: its triangle, or -1
  double sharp_angle = 0.52359877559829887;  // pi / 6
  std::span<const Edge> sharp_edges = {};    // rows of vertices
  bool smooth = false;
};

}  // namespace medial
