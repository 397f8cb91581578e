// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the hierarchy of the inner medial axis.
#pragma once

#include <medial/faces.h>
#include <medial/hierarchy.h>

#include "axis/selection.h"
#include "base/frame.h"
#include "delaunay/samples.h"

namespace medial {

// Makes the hierarchy. The sides of `facets` must be decided; they and the samples are in the
// coordinates of `frame`, which the hierarchy keeps. With faces, those of the solid, sheets reach
// sharp edges, and with `places` vertices also get crisp places. Throws InvalidInputError for
// thresholds out of range.
Hierarchy make_hierarchy(const Samples& samples, const Facets& facets, const Thresholds& thresholds,
                         const FacesInput* faces, std::span<const int32_t> partners, bool places,
                         const Frame& frame, const Run& run);

}  // namespace medial
