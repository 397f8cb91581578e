// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the end of a smooth sheet, where the two places that a ball touches become one.
#pragma once

#include "exact/empty_ball.h"

namespace medial {

// Tells how far the end of a sheet is; 0 if none is near.
struct SmoothRim {
  double reach = 0;
  bool at_wall = false;  // whether a third wall ends the sheet
};

// Returns how far a smooth rim is from a ball that touches two places.
SmoothRim smooth_rim_of(const Faces& faces, double hole, const Touch& inner);

}  // namespace medial
