// SPDX-License-Identifier: GPL-3.0-or-later
// The noise of points is measured from the points alone: quadrics are fitted to neighbourhoods of
// growing size. Curvature makes the residuals grow all along; noise makes a plateau.
#pragma once

#include "base/point_tree.h"

namespace medial {

struct NoiseFigures {
  double spacing = 0, noise = 0, kurtosis = 3;
};

// Measures points in spatial order, of which the tree was made.
NoiseFigures noise_of(const PointTree& tree, double diagonal, const Run& run);

}  // namespace medial
