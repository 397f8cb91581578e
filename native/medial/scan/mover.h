// SPDX-License-Identifier: GPL-3.0-or-later
// Points are moved onto the quadric of the largest neighbourhood with which all smaller ones agree
// (Lepski's rule).
#pragma once

#include "base/point_tree.h"

namespace medial {

// The points round a place that one quadric fits.
struct Neighbourhood {
  double first = 0;   // the radius of the smallest one at that place
  double radius = 0;  // 0: no quadric fits
  double left = 0;    // the standard deviation that is left of the noise
};

// The place to which a point is moved.
struct Moved {
  Vec3 place;
  Neighbourhood of;  // with a radius of 0 the point belongs to no surface
};

// Returns the neighbourhoods of all points of a tree in spatial order; `noise` is their standard
// deviation. The widest is chosen at the centres, and others take that of the nearest centre.
// Neighbourhoods are at most `largest` wide.
std::vector<Neighbourhood> neighbourhoods(const PointTree& tree, std::span<const int32_t> centres,
                                          double noise, double largest, const Run& run);

// Moves some points of the tree, given the neighbourhoods of all.
std::vector<Moved> moved_points(const PointTree& tree, std::span<const int32_t> centres,
                                std::span<const Neighbourhood> neighbourhoods, double noise,
                                const Run& run);

}  // namespace medial
