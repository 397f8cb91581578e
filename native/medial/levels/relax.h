// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the wires of a level smooth curves: they are divided anew and fitted to the samples. The
// topology and the facets do not change; `exact` has the corresponding vertices of the exact level.
#pragma once

#include "levels/level.h"

namespace medial {

// Relaxes a level. With `to_faces`, curves end in the tips of cones of the faces.
void relax(Level& level, const Hierarchy::Parts& hierarchy, bool to_faces, const Run& run);

}  // namespace medial
