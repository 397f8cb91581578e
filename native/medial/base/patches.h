// SPDX-License-Identifier: GPL-3.0-or-later
// Connected parts of a surface.
#pragma once

#include <span>
#include <vector>

#include "base/triangle.h"

namespace medial {

// Per triangle the number of its patch: `wanted` ones that share a corner are in one. Patches are
// numbered in the order of their first triangles; -1: not wanted. The corners are in [0, vertices).
std::vector<int32_t> patches(std::span<const Triangle> triangles, std::span<const uint8_t> wanted,
                             size_t vertices);

}  // namespace medial
