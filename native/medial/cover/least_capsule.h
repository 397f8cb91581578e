// SPDX-License-Identifier: GPL-3.0-or-later
// The capsule of least volume that holds given places.
#pragma once

#include <span>

#include "cover/capsule_fit.h"

namespace medial {

// Returns a capsule that holds all places, of nearly the least volume: of the least capsules along
// each of some directions the smallest, whose ends are then moved as long as that makes it smaller.
// There must be a place.
Capsule least_capsule(std::span<const Vec3> places, bool tapered);

}  // namespace medial
