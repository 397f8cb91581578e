// SPDX-License-Identifier: GPL-3.0-or-later
// Tells how the connected parts of faces lie to each other.
#pragma once

#include "inside/mesh_parts.h"

namespace medial {

enum class PartPlace : uint8_t {
  apart,        // it meets no other part
  touching,     // it meets others, and shares no volume with them
  within,       // it lies inside another part, and its faces pass through none
  overlapping,  // it shares a part of its volume with others: together they are one solid
  sheet,        // it has no thickness: most of its faces do not bound what it encloses
};

// Returns the place of each part; `parts` is the result of mesh_parts for the same faces. Sheets
// meet nothing. Parts touch where they are within the rounding of their corners to float32. Nothing
// is searched for where no bounding boxes meet and no part is open. Throws as mesh_parts does.
std::vector<PartPlace> part_places(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                                   const MeshParts& parts, const Run& run);

}  // namespace medial
