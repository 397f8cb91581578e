// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a level look smooth: rims are smoothed, and wires are divided anew and fitted to the
// samples. Its topology and its facets do not change; `exact` has the corresponding vertices of the
// exact level.
#pragma once

#include "skeleton/level.h"

namespace medial {

// Relaxes a level; `rims` are its edges with exactly one facet. Vertices at crisp places stay on
// convex creases.
void relax(Level& level, std::span<const Edge> rims, const Hierarchy::Parts& hierarchy, bool crisp,
           const Run& run);

}  // namespace medial
