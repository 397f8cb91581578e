// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the connected parts of faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/run.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

struct MeshParts {
  // The part of each face, in the order of their first faces; -1 for a face that repeats a corner.
  std::vector<int32_t> part;
  int32_t count = 0;
  // Whether a part has an edge whose faces do not use it equally often in both directions.
  std::vector<uint8_t> open;
  // Whether a part lies in a plane, up to the rounding of its corners.
  std::vector<uint8_t> flat;
};

// Faces are in one part where they share an edge; rows with the same coordinates are one vertex.
// Parts that touch at a vertex alone stay two. Throws InvalidInputError for a corner outside the
// rows and for rows that are not finite.
MeshParts mesh_parts(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                     const Run& run);

}  // namespace medial
