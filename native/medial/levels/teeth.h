// SPDX-License-Identifier: GPL-3.0-or-later
// Where sheets recede, narrow facets stick out of their new rims like teeth, because facets go as a
// whole.
#pragma once

#include "collapse/betti.h"

namespace medial {

// Removes facets that hang together with others along a small part of their boundary only, each
// with the rest of its boundary, so that the topology stays.
void trim_teeth(const InnerComplex& complex, Alive& alive, const Run& run);

}  // namespace medial
