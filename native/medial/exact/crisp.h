// SPDX-License-Identifier: GPL-3.0-or-later
// Crisp places: each vertex of the axis moves from the Voronoi diagram of the samples to the exact
// medial axis of the faces. It becomes the centre of the ball that touches the walls on which its
// samples lie; where a sheet ends at a convex crease, the vertex goes onto the crease. Cells do not
// change, so all levels keep their topology.
#pragma once

#include <medial/hierarchy.h>

#include "collapse/values.h"
#include "walls/samples_on_faces.h"

namespace medial {

// How far the bar of a hierarchy is where this stage begins, which ends it.
inline constexpr double kBarOfCrispPlaces = 0.32;  // work: progress

struct CrispPlaces {
  Array<Vec3> position;  // (v)
  Array<double> radius;  // (v) the distance to the faces, unless `place` is voronoi or refused
  Array<Placing> place;  // (v)
};

// Returns the places of the vertices of a complex, at facets that are thicker than one spacing;
// `facets` has the values of all. `selected` tells for each shrunk facet whether it was selected.
// The distance to the faces was verified for every vertex that moved.
CrispPlaces crisp_places(const InnerComplex& complex, const Triangulation& triangulation,
                         const SamplesOnFaces& samples, std::span<const Thickness> facets,
                         std::span<const double> sine, std::span<const uint8_t> selected,
                         const Run& run);

// Returns for each vertex whether a rim there ends on a convex crease.
Array<uint8_t> vertices_on_creases(const InnerComplex& complex, const Triangulation& triangulation,
                                   const SamplesOnFaces& samples, std::span<const Thickness> facets,
                                   const Run& run);

}  // namespace medial
