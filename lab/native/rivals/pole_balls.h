// SPDX-License-Identifier: GPL-3.0-or-later
// The poles as balls are the medial axis of Amenta & Bern (1998) and of Boissonnat & Cazals (2001).
#pragma once

#include <medial/medial_mesh.h>

#include "axis/poles.h"
#include "delaunay/samples.h"
#include "inside/sides.h"

namespace medial {

// Returns the Voronoi vertices that are p+ or p- of a sample, the farthest of its cell and the
// farthest opposite to it, on one side or on both; poles at infinity are left out. They are in the
// order of the samples' rows, p+ first. `incident` is the result of incident_cells.
MedialMesh pole_balls(const Samples& samples, const Triangulation& triangulation,
                      const Voronoi& voronoi, const Csr<int32_t>& incident, const CellSides& sides,
                      Side side, const Run& run);

}  // namespace medial
