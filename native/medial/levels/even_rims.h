// SPDX-License-Identifier: GPL-3.0-or-later
// Smooths the rims that a level of an even mesh has where triangles of the mesh are left out.
#pragma once

#include "levels/level.h"

namespace medial {

// Remeshes a level of an even mesh near triangles that are left out, where its rims follow edges of
// the mesh, and its vertices there go to where balls touch the faces, if these are known. All else
// stays as it is. `alive` are the cells of the level.
void smooth_new_rims(Level& level, const Hierarchy::Parts& hierarchy, const Alive& alive,
                     const Run& run);

}  // namespace medial
