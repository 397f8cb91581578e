// SPDX-License-Identifier: GPL-3.0-or-later
// How exactly coordinates are known.
#pragma once

#include <span>

#include "base/vec3.h"

namespace medial {

// Returns whether coordinates were rounded to float32: all of them are such numbers, and some use
// the last bit that these have, as whole numbers of few digits do not.
bool are_single(std::span<const Vec3> rows);

// Returns how far apart places may be that were meant to be one, and how far points may be from the
// plane that they were meant to lie in: four roundings to float32, in which meshes are stored.
// Those of coordinates that were rounded grow with the distance from the origin. Others are known
// better, whatever made them, and it is the size of their box that counts, wherever that lies.
// `far` is the largest coordinate before the rows were moved, 0 where they were not.
double rounding_of(std::span<const Vec3> rows, double far = 0);

}  // namespace medial
