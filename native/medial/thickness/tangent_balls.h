// SPDX-License-Identifier: GPL-3.0-or-later
// The balls of one side that are tangent to the surface at a sample and touch another one.
#pragma once

#include <medial/options.h>

#include "delaunay/edges.h"

namespace medial {

// The sides of a wall are samples whose normals differ by 120 degrees or more; this is the cosine.
inline constexpr double kWallCosine = -0.5;

// The surface at each sample, as far as it is known.
struct Tangents {
  std::vector<Vec3> normals;  // outward unit vectors; zero: not known
  // On a sharp edge, where the normal is a mean that no ball is tangent to.
  std::vector<uint8_t> edge;
  // The samples among these whose edge stands into the side of the balls, so that they can touch
  // it.
  std::vector<uint8_t> reflex;
};

// Per sample the diameter of the smallest such ball: of any, and of those between walls. Infinite
// where there is none.
struct TangentBalls {
  std::vector<double> any, wall;
  std::vector<uint8_t> touched;  // it has a facet
};

// By the facets dual to `edge_ids`, all of one side, inner or outer.
TangentBalls tangent_balls(std::span<const Vec3> points, const Tangents& tangents,
                           const Edges& edges, std::span<const int32_t> edge_ids, Side side,
                           const Run& run);

}  // namespace medial
