// SPDX-License-Identifier: GPL-3.0-or-later
// This chooses balls greedily to cover most of a solid.
#pragma once

#include <medial/ball_cover.h>

#include "base/run.h"

namespace medial {

BallCover ball_cover(const BallCoverInput& input, const BallCoverOptions& options, const Run& run);

}  // namespace medial
