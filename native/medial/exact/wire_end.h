// SPDX-License-Identifier: GPL-3.0-or-later
// A wire that ends at a sheet, as the axis of a cylinder does, ends where the ball touches walls
// all round it and one before it.
#pragma once

#include "exact/empty_ball.h"

namespace medial {

// Returns that ball near one that touches the walls of the sheet; `along` is the direction of the
// wire there. Its radius is 0 where there is none.
Touch wire_end(const SamplesOnFaces& samples, double hole, const Touch& at, const Vec3& along);

}  // namespace medial
