// SPDX-License-Identifier: GPL-3.0-or-later
// Gives the sheets of a level a mesh of their own. The samples decide the topology; the facets of
// the Voronoi diagram, which are as many as the samples, become even triangles.
#pragma once

#include "levels/even_level.h"

namespace medial {

// Replaces the polygons of a level by even triangles. Its vertices are at the Voronoi diagram, and
// the polygons are in the order of their generators; so are the triangles. If `crisp`, vertices go
// to where balls touch the faces, if there are any.
EvenVertices make_even(Level& level, const Hierarchy::Parts& hierarchy, bool crisp, const Run& run);

}  // namespace medial
