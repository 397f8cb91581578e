// SPDX-License-Identifier: GPL-3.0-or-later
// A level for the eye: its rims smoothed, its wires divided anew and fitted to the samples. What it
// shows of the exact level it says in `exact`; its topology and its facets are the same.
#pragma once

#include "skeleton/level.h"

namespace medial {

// `rims`: edges with exactly one facet.
void relax(Level& level, std::span<const Edge> rims, const Hierarchy::Parts& hierarchy,
           const Run& run);

}  // namespace medial
