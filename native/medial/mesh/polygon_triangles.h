// SPDX-License-Identifier: GPL-3.0-or-later
// Divides polygons into triangles, without new vertices.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/vec3.h"

namespace medial {

// Divides polygon i, which has the corners [face_offsets[i], face_offsets[i + 1]), rows of
// `points`, at least three. It gives two triangles fewer than it has corners; they have its
// boundary and its orientation. The triangles of polygon i begin at face_offsets[i] - 2 i.
//
// A triangle stays. A quad is cut from its first corner to its third, as in Blender, or, if it is
// not convex there, from its second to its fourth. A larger polygon gets its constrained Delaunay
// triangulation in the projection along the axis nearest to its normal; it may touch itself, as
// where a bridge joins a hole to its rim. If corners lie on other sides, or the polygon crosses
// itself, the sum of all areas is made as small as possible, up to 64 corners; beyond, every other
// corner is cut off, repeatedly.
//
// Throws InvalidInputError for invalid polygons, and for corners whose coordinates are not finite.
std::vector<Triangle> polygon_triangles(std::span<const Vec3> points,
                                        std::span<const int32_t> face_offsets,
                                        std::span<const int32_t> face_vertices, const Run& run);

}  // namespace medial
