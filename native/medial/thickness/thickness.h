// SPDX-License-Identifier: GPL-3.0-or-later
// This computes thickness and gaps at the samples, from the facets of one side.
#pragma once

#include <medial/thickness.h>

#include "axis/selection.h"
#include "delaunay/samples.h"

namespace medial {

// The result ascends by row. `normals` and `at_edge` have one row per point. The sides of `facets`
// must be known.
WallThickness thickness(const ThicknessInput& input, const ThicknessOptions& options,
                        const Samples& samples, const Facets& facets, const Run& run);

}  // namespace medial
