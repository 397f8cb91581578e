// SPDX-License-Identifier: GPL-3.0-or-later
// Cocone's manifold extraction turns candidate triangles into an oriented surface with at most two
// triangles at every edge.
#pragma once

#include "cocone/cocone.h"

namespace medial {

// Returns the triangles of the surface, each once, as seen from the cell on its front side. The
// fronts of neighbouring triangles are on the same side of the surface.
FaceSet manifold(std::span<const Vec3> points, const Triangulation& triangulation,
                 const Csr<int32_t>& incident, const Cocone& cocone, const CoconeOptions& options,
                 const Run& run);

}  // namespace medial
