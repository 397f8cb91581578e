// SPDX-License-Identifier: GPL-3.0-or-later
// Cocone's manifold extraction: candidate triangles -> an oriented surface with at most two
// triangles at every edge.
#pragma once

#include "cocone/cocone.h"

namespace medial {

// The triangles of the surface, each once: seen from the cell on its front side. Neighbours on the
// surface have their fronts on the same side of it.
FaceSet manifold(std::span<const Vec3> points, const Triangulation& triangulation,
                 const Csr<int32_t>& incident, const Cocone& cocone, const CoconeOptions& options,
                 const Run& run);

}  // namespace medial
