// SPDX-License-Identifier: GPL-3.0-or-later
// The surface that Tight Cocone found, in terms of the input rows.
#pragma once

#include <medial/watertight_surface.h>

#include "cocone/peeling.h"
#include "cocone/solid.h"
#include "delaunay/samples.h"

namespace medial {

// Triangles of samples as triangles of rows: lowest row first, in lexicographic order.
std::vector<Triangle> in_rows(std::vector<Triangle> triangles, const Samples& samples,
                              const Run& run);

// In terms of the rows.
WatertightSurface describe(TightCocone found, SolidBoundary boundary, const Samples& samples,
                           const Run& run);

}  // namespace medial
