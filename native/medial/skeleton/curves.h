// SPDX-License-Identifier: GPL-3.0-or-later
// Curves more exact than Voronoi vertices. Wires run on Voronoi edges, which go to and fro along a
// limb. Smoothing takes that away; then the chain is divided anew, by steps of a quarter of the
// spacing of the samples, and a canal surface is fitted at each new vertex.
#pragma once

#include "base/point_tree.h"
#include "base/run.h"
#include "skeleton/canal.h"
#include "skeleton/chains.h"

namespace medial {

// A chain divided anew: all between its ends is new; these stay but for loose ones, which are
// fitted.
struct Curve {
  std::vector<double> at;       // on the chain: 2.25 is a quarter of the way from vertex 2 to 3
  std::vector<double> spacing;  // of the samples there
  std::vector<Canal> canal;
};

// `places` are of the vertices of the chains. In the order of the chains. A closed curve ends with
// the copy of its first vertex.
std::vector<Curve> fit_curves(const std::vector<Chain>& chains, std::span<const Vec3> places,
                              const PointTree& samples, const Run& run);

}  // namespace medial
