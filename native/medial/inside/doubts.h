// SPDX-License-Identifier: GPL-3.0-or-later
// Finds where samples are too sparse for the topology of the surface that they lie on.
#pragma once

#include <span>

#include "delaunay/voronoi.h"
#include "inside/ray_crossings.h"

namespace medial {

struct DoubtInput {
  std::span<const Vec3> points;
  std::span<const Vec3> normals;  // per sample, outward unit normals or zero
  std::span<const double> reach;  // per sample; no place of the surface nearby is farther away
  const Triangulation& triangulation;
  const Voronoi& voronoi;
};

// Holds a place where a Voronoi edge meets the surface although it should not, and how far it is
// from there to the next such place, or to the samples.
struct Doubt {
  Vec3 place;
  double gap;
};

// Returns the places where the surface lacks the ball property of Edelsbrunner & Shah (1997): a
// Voronoi edge should meet the surface at most once, and its three samples should be on the same
// wall as that place. A sample is on another wall if its normal looks the other way. Of an edge
// only the part within the reach of its samples counts. The order is that of the cells.
std::vector<Doubt> doubts(const DoubtInput& input, const RayCrossings& surface, const Run& run);

}  // namespace medial
