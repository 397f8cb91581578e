// SPDX-License-Identifier: GPL-3.0-or-later
// Finds where small triangles do not count for the normals of a smooth surface: beside walls. The
// rows of a bevel or a fillet would lean their normals, and bend them.
#pragma once

#include <span>

#include "sampling/flat_parts.h"

namespace medial {

// The fans of a mesh: the corners of triangles that smooth edges join at a vertex.
struct Fans {
  std::vector<Triangle> of;  // (m) the fan of each corner of a triangle
  std::vector<int32_t>
      first;  // per fan: its first corner, which is three times a triangle plus 0-2
};

Fans smooth_fans(const TriangleMesh& mesh, const Creases& creases);

// Returns for each fan the doubled area up to which flat parts do not count there; 0 where all do.
// `edge_of` holds the edges of each triangle, from each corner to the next.
std::vector<double> areas_beside_walls(const TriangleMesh& mesh, const Creases& creases,
                                       const FlatParts& flat, const Fans& fans,
                                       std::span<const Triangle> edge_of);

}  // namespace medial
