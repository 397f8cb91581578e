// SPDX-License-Identifier: GPL-3.0-or-later
// Fits curves that are more exact than Voronoi vertices. Wires follow Voronoi edges, which zigzag
// along a limb. Smoothing removes the zigzag; then the chain is divided anew into steps of a
// quarter of the sample spacing, and a canal surface is fitted at each new vertex.
#pragma once

#include "base/point_tree.h"
#include "base/run.h"
#include "levels/canal.h"
#include "levels/chains.h"

namespace medial {

// A curve is a chain that is divided anew: all vertices between its ends are new. The ends stay,
// but loose ends are fitted.
struct Curve {
  std::vector<double> at;  // place on the chain: 2.25 is a quarter of the way from vertex 2 to 3
  std::vector<double> spacing;  // between the samples there
  std::vector<Canal> canal;
};

// Returns the curves in the order of the chains; `places` are the positions of the chains'
// vertices. A closed curve ends with the copy of its first vertex.
std::vector<Curve> fit_curves(const std::vector<Chain>& chains, std::span<const Vec3> places,
                              const PointTree& samples, const Run& run);

}  // namespace medial
