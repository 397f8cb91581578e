// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the hierarchy of an even mesh. The mesh has the topology of the solid, so every collapse of
// it keeps the topology, too, and all measures of the hierarchy are found on it as they are on the
// facets of the Voronoi diagram, of which there are many times more.
#pragma once

#include "levels/level.h"

namespace medial {

// See Hierarchy::even.
std::shared_ptr<const Hierarchy::Parts> even_parts(const Hierarchy::Parts& of,
                                                   const EvenOptions& options, const Run& run);

// See Hierarchy::selecting.
std::shared_ptr<const Hierarchy::Parts> parts_selecting(const Hierarchy::Parts& of, double theta,
                                                        double rho, const Run& run);

}  // namespace medial
