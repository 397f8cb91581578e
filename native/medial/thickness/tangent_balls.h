// SPDX-License-Identifier: GPL-3.0-or-later
// These balls of one side are tangent to the surface at a sample and touch another one.
#pragma once

#include <medial/options.h>

#include "delaunay/edges.h"

namespace medial {

// This describes the surface at each sample.
struct Tangents {
  std::vector<Vec3> normals;  // outward unit vectors; zero if unknown
  // This marks samples on a sharp edge, where the normal is a mean that no ball is tangent to.
  std::vector<uint8_t> edge;
  // This marks those of them whose edge juts into the side of the balls, so that balls can touch
  // it.
  std::vector<uint8_t> reflex;
};

// These are the diameters of the smallest ball at each sample: of any, and of those between walls.
// They are infinite if there is none.
struct TangentBalls {
  std::vector<double> any, wall;
  std::vector<uint8_t> touched;  // the sample has a facet
};

// Computes the balls from the facets dual to `edge_ids`, all of one side, inner or outer. `spacing`
// is how far the samples round each sample are away.
TangentBalls tangent_balls(std::span<const Vec3> points, const Tangents& tangents,
                           const Edges& edges, std::span<const double> spacing,
                           std::span<const int32_t> edge_ids, Side side, const Run& run);

}  // namespace medial
