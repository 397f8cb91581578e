// SPDX-License-Identifier: GPL-3.0-or-later
// These functions find the edges of polygons that share vertices, and their areas and normals.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

struct PolygonEdges {
  std::vector<Edge> ends;          // lower vertex first, in lexicographic order
  std::vector<int32_t> of_corner;  // the edge from each corner to the next one of its polygon
};

// Throws InvalidInputError unless the offsets ascend from 0 to the number of corners, and the
// corners are in [0, vertices).
void require_polygons(std::span<const int32_t> face_offsets, std::span<const int32_t> corners,
                      int32_t vertices);

// Polygon i has the corners [face_offsets[i], face_offsets[i + 1]), vertices in [0, vertices).
// Throws InvalidInputError.
PolygonEdges polygon_edges(std::span<const int32_t> face_offsets, std::span<const int32_t> corners,
                           int32_t vertices, const Run& run);

// Returns a vector for each polygon along its normal, twice as long as its area is large. Throws
// InvalidInputError.
std::vector<Vec3> doubled_areas(std::span<const Vec3> points, std::span<const int32_t> face_offsets,
                                std::span<const int32_t> corners, const Run& run);

}  // namespace medial
