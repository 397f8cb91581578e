// SPDX-License-Identifier: GPL-3.0-or-later
// Round limbs: of the wires that only their length keeps, those along which the samples lie all
// round. What else such wires run along are ridges, as terraces and noise have them by the hundred.
#pragma once

#include "skeleton/betti.h"
#include "skeleton/level.h"

namespace medial {

// Takes the other ones away, from their loose ends. A chain of wires stays if it is round along
// half of its length, or carries one that stays.
void shed_flat_limbs(const Hierarchy::Parts& hierarchy, const LevelOptions& options, Alive& alive,
                     const Run& run);

}  // namespace medial
