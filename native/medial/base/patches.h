// SPDX-License-Identifier: GPL-3.0-or-later
// A patch is a connected part of a surface.
#pragma once

#include <span>
#include <vector>

#include "base/triangle.h"

namespace medial {

// Returns the number of the patch of each triangle: `wanted` triangles that share a corner are in
// the same one. Patches are numbered in the order of their first triangles; triangles that are not
// wanted get -1. The corners are in [0, vertices).
std::vector<int32_t> patches(std::span<const Triangle> triangles, std::span<const uint8_t> wanted,
                             size_t vertices);

}  // namespace medial
