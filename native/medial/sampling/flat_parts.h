// SPDX-License-Identifier: GPL-3.0-or-later
// The flat parts of a mesh: triangles that lie in one plane and are joined by edges.
#pragma once

#include "sampling/creases.h"

namespace medial {

// Each array has one row per triangle, about the part that it belongs to.
struct FlatParts {
  std::vector<int32_t> part;   // the largest triangle of the part names it
  std::vector<double> area;    // twice the area
  std::vector<double> width;   // twice the area by the length of the border: of a strip, its width
  std::vector<uint8_t> alone;  // whether the triangle is the whole part
};

// Triangles are of one plane up to the rounding to float32.
FlatParts flat_parts(const TriangleMesh& mesh, const Creases& creases);

// Returns how far a triangle reaches from one of its edges.
double reach_from(const TriangleMesh& mesh, int32_t triangle, const Edge& edge);

}  // namespace medial
