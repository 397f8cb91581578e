// SPDX-License-Identifier: GPL-3.0-or-later
// Tells whether two triangles meet.
#pragma once

#include <cstdint>

#include "inside/solid_angle.h"

namespace medial {

enum class TriangleMeeting : uint8_t {
  none,
  touch,    // they are within a distance of each other
  crossed,  // an edge of one passes through the middle of the other, farther than that on each side
};

TriangleMeeting meeting_of(const Corners& first, const Corners& second, double within);

}  // namespace medial
