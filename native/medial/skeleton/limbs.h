// SPDX-License-Identifier: GPL-3.0-or-later
// Limbs: branches of the wires, each with one value from its tip to where it ends at a longer one.
#pragma once

#include "skeleton/wires.h"

namespace medial {

// Per vertex that went with a wire in stage 3, as shares of the diagonal, 0 for those that went
// before and infinite for those that stay: the smaller of how long its branch is (the largest
// elongation) and how far it sticks out (the tip's ball out of the ball at its end). Tips of plates
// stick out, terraces are long; limbs are both. Of noisy samples a limb may begin with a turn, and
// is soon no longer known by its tip: where that says less than a quarter of it, what counts is the
// ball of the branch by length that sticks out most.
Array<float> limb_values(const InnerComplex& complex, const Collapse& collapse, const Wires& wires,
                         const Run& run);

}  // namespace medial
