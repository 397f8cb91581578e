// SPDX-License-Identifier: GPL-3.0-or-later
// Thickness and gaps at the samples, by the facets of one side.
#pragma once

#include <medial/thickness.h>

#include "axis/selection.h"
#include "delaunay/samples.h"

namespace medial {

// Ascending by row. `normals` and `at_edge` have one row per point. The sides of `facets` are
// known.
WallThickness thickness(const ThicknessInput& input, const ThicknessOptions& options,
                        const Samples& samples, const Facets& facets, const Run& run);

}  // namespace medial
