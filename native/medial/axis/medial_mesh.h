// SPDX-License-Identifier: GPL-3.0-or-later
// This makes the polygons of the selected Voronoi facets, the output of MEDIAL(P).
#pragma once

#include <medial/medial_mesh.h>

#include "axis/selection.h"
#include "delaunay/samples.h"

namespace medial {

// Returns the selected facets as a mesh.
MedialMesh voronoi_facets(const Selection& selection, const Samples& samples,
                          const Triangulation& triangulation, const Voronoi& voronoi,
                          const Edges& edges, const Run& run);

}  // namespace medial
