// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the polygons of the selected Voronoi facets: output of MEDIAL(P).
#pragma once

#include <medial/medial_mesh.h>

#include "axis/selection.h"
#include "delaunay/samples.h"

namespace medial {

// The selected facets.
MedialMesh voronoi_facets(const Selection& selection, const Samples& samples,
                          const Triangulation& triangulation, const Voronoi& voronoi,
                          const Edges& edges, const Run& run);

}  // namespace medial
