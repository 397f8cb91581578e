// SPDX-License-Identifier: GPL-3.0-or-later
// The noise of points is measured from the points alone: quadrics are fitted to neighbourhoods of
// growing size. Curvature makes the residuals grow all along; noise makes a plateau.
#pragma once

#include "base/point_tree.h"

namespace medial {

constexpr double kSameWay = 0.2;  // least cosine of normals that look one way; chosen: unseen
// The radius of neighbourhoods, as a share of the diagonal; a larger one is the shape itself.
constexpr double kWidest = 0.12;  // chosen: axis

struct NoiseFigures {
  double spacing = 0, noise = 0, kurtosis = 3, mates = 0;
  double radius = 0;  // of the widest neighbourhoods on the plateau; it matters for faces only
};

// Measures points in spatial order, of which the tree was made. With unit normals of the points,
// only those whose normals look the same way are compared.
NoiseFigures noise_of(const PointTree& tree, double diagonal, const Run& run,
                      std::span<const Vec3> normals = {});

}  // namespace medial
