// SPDX-License-Identifier: GPL-3.0-or-later
// Divides the polygons of a level into triangles whose edges are all different, so that the mesh is
// a simplicial complex with the topology of the level.
#pragma once

#include <medial/hierarchy.h>

#include "base/run.h"
#include "base/triangle.h"

namespace medial {

struct Simplices {
  std::vector<Triangle> triangles;
  std::vector<int32_t> source;   // (t) the polygon
  std::vector<int32_t> centres;  // polygons that got a vertex in their middle, after all others
};

// Polygons become fans from their first corner. Samples on a common sphere may cause polygons of
// which some have a diagonal in common with each other or with an edge; these get a vertex in their
// middle.
Simplices simplices_of(const Level& level, const Run& run);

}  // namespace medial
