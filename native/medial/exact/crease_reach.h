// SPDX-License-Identifier: GPL-3.0-or-later
// Which creases of the faces a rim ends in, the same for Voronoi facets and for even meshes.
// Lengths are in holes between the samples.
#pragma once

#include "walls/samples_on_faces.h"

namespace medial {

inline constexpr double kCreaseBall = 8;  // the largest ball that ends in a crease; chosen: unseen
inline constexpr double kCornerReach = 2.5;  // from a rim to a corner of a solid; chosen: axis

// Returns how far a crease may be from a vertex of a rim that ends in it; 0 where none ends there.
double crease_reach(const SamplesOnFaces& samples, const PlaceOnCrease& place);

// Returns whether two places lie on creases of one direction.
bool same_direction(const SamplesOnFaces& samples, const PlaceOnCrease& a, const PlaceOnCrease& b);

}  // namespace medial
