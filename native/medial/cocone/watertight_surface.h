// SPDX-License-Identifier: GPL-3.0-or-later
// Converts the surface that Tight Cocone found to input rows.
#pragma once

#include <medial/watertight_surface.h>

#include "cocone/peeling.h"
#include "cocone/solid.h"
#include "delaunay/samples.h"

namespace medial {

// Converts triangles of samples to triangles of rows: lowest row first, in lexicographic order.
std::vector<Triangle> in_rows(std::vector<Triangle> triangles, const Samples& samples,
                              const Run& run);

// Returns the result for the caller, in terms of the input rows.
WatertightSurface describe(TightCocone found, SolidBoundary boundary, const Samples& samples,
                           const Run& run);

}  // namespace medial
