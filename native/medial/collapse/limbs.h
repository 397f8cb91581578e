// SPDX-License-Identifier: GPL-3.0-or-later
// Limbs are branches of the wires; each has one value from its tip to its end at a longer branch.
#pragma once

#include "collapse/wires.h"

namespace medial {

// Returns a value for each vertex that was removed with a wire in stage 3, as a share of the
// diagonal; 0 for vertices removed before, and infinity for those that stay. The value is the
// smaller one of the length of its branch (the largest elongation) and its protrusion (how far the
// tip's ball sticks out of the ball at its end). Tips of plates stick out, and terraces are long;
// limbs are both. With noisy samples a limb may begin with a turn, and soon its tip does not
// identify it: where the tip gives less than a quarter of it, the value is that of the ball which
// sticks out most on the branch by length.
Array<float> limb_values(const InnerComplex& complex, const Collapse& collapse, const Wires& wires,
                         const Run& run);

}  // namespace medial
