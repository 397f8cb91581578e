// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace medial {

// Returns the order in which points are inserted into a triangulation: biased and randomized
// (Amenta, Choi, Rote 2003). Each round has an eighth of the points of the next one, and keeps the
// spatial order of the ids.
std::vector<int32_t> insertion_order(int32_t count);

}  // namespace medial
