// SPDX-License-Identifier: GPL-3.0-or-later
// Finds mitres: edges along which a crease continues although its turn has become less than sharp.
// Where two straight fillets meet, the turn from one to the other fades from wall to flat face.
#pragma once

#include "sampling/creases.h"

namespace medial {

// Marks mitres as sharp. A crease that ends at a vertex continues from there if a normal shared by
// both sides would bend an edge by more than the height of a triangle next to it.
void mark_mitres(const TriangleMesh& mesh, Creases& creases);

}  // namespace medial
