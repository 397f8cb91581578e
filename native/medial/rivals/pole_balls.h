// SPDX-License-Identifier: GPL-3.0-or-later
// The poles as balls: the medial axis of Amenta & Bern (1998) and of Boissonnat & Cazals (2001).
#pragma once

#include <medial/medial_mesh.h>

#include "axis/poles.h"
#include "delaunay/samples.h"
#include "inside/sides.h"

namespace medial {

// The Voronoi vertices that are p+ or p- of a sample, the farthest of its cell and the farthest
// against it, on one side or on both; a pole at infinity is none. In the order of the samples'
// rows, p+ first. `incident` as from incident_cells.
MedialMesh pole_balls(const Samples& samples, const Triangulation& triangulation,
                      const Voronoi& voronoi, const Csr<int32_t>& incident, const CellSides& sides,
                      Side side, const Run& run);

}  // namespace medial
