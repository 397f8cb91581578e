// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the hierarchy of the inner medial axis.
#pragma once

#include <medial/hierarchy.h>

#include "axis/selection.h"
#include "base/frame.h"
#include "delaunay/samples.h"

namespace medial {

// `facets` know their sides; they and the samples are seen in `frame`, which the hierarchy keeps.
// Throws InvalidInputError for thresholds out of range.
Hierarchy make_hierarchy(const Samples& samples, const Facets& facets, const Thresholds& thresholds,
                         const Frame& frame, const Run& run);

}  // namespace medial
