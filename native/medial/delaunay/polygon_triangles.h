// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons as triangles, without new vertices.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/vec3.h"

namespace medial {

// Polygon i has the corners [face_offsets[i], face_offsets[i + 1]), rows of `points`, three at
// least. It becomes as many triangles as it has corners, less two, which have its boundary and turn
// as it does: triangles of polygon i begin at face_offsets[i] - 2 i.
//
// A triangle stays. A quad is cut from its first corner to its third, as Blender does, or where it
// is not convex there, from its second to its fourth. Larger polygons get their constrained
// Delaunay triangulation, seen along the axis nearest to their normal; they may touch themselves,
// as where a hole is joined to its rim by a bridge. One that crosses itself bounds no region: every
// other of its corners is cut off, again and again.
//
// Throws InvalidInputError, as for corners whose coordinates are not finite.
std::vector<Triangle> polygon_triangles(std::span<const Vec3> points,
                                        std::span<const int32_t> face_offsets,
                                        std::span<const int32_t> face_vertices, const Run& run);

}  // namespace medial
