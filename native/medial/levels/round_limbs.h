// SPDX-License-Identifier: GPL-3.0-or-later
// Finds round limbs: those of the wires kept only by their length along which samples lie all
// round. The other ones follow ridges, which terraces and noise have in hundreds.
#pragma once

#include "collapse/betti.h"
#include "levels/level.h"

namespace medial {

// Removes the wires that are not round, from their loose ends. A chain of wires stays if it is
// round along half of its length, or carries a chain that stays.
void shed_flat_limbs(const Hierarchy::Parts& hierarchy, const LevelOptions& options, Alive& alive,
                     const Run& run);

}  // namespace medial
