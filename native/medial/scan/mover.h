// SPDX-License-Identifier: GPL-3.0-or-later
// Points are moved onto the quadric of the largest neighbourhood with which all smaller ones agree
// (Lepski's rule).
#pragma once

#include "base/point_tree.h"

namespace medial {

// The place to which a point is moved.
struct Moved {
  Vec3 place;
  double radius = 0;  // of the neighbourhood; 0: the point belongs to no surface
  double left = 0;    // the standard deviation that is left of the noise
};

// Moves some of the points of a tree in spatial order; `noise` is their standard deviation.
// Neighbourhoods are at most `largest` wide.
std::vector<Moved> moved_points(const PointTree& tree, std::span<const int32_t> centres,
                                double noise, double largest, const Run& run);

}  // namespace medial
