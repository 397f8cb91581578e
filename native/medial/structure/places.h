// SPDX-License-Identifier: GPL-3.0-or-later
// An order of things by where they are, which small changes of the places do not change.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"

namespace medial {

// A thing has keys and a place; places closer than `apart` in a coordinate count as equal there.
struct Placed {
  std::vector<int32_t> keys;
  Vec3 place;
  double apart = 0;
};

// Returns the ids in the order of the keys, then of x, y and z, then of the ids.
std::vector<int32_t> order_of(std::span<const Placed> things);

}  // namespace medial
