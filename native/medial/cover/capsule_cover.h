// SPDX-License-Identifier: GPL-3.0-or-later
// This makes capsules that cover most of a solid, or all of it.
#pragma once

#include <medial/capsule_cover.h>

#include "base/run.h"

namespace medial {

CapsuleCover capsule_cover(const CapsuleCoverInput& input, const CapsuleCoverOptions& options,
                           const Run& run);

}  // namespace medial
