// SPDX-License-Identifier: GPL-3.0-or-later
// Marking determines on which side of the surface each sample sees its cells, and which samples
// agree about the sides (Dey & Goswami 2003).
#pragma once

#include "cocone/manifold.h"

namespace medial {

// Tells on which side of the surface a cell is as seen from one of its corners; `none` means
// unknown.
enum class Facing : uint8_t { none, front, back };

struct Marks {
  std::vector<uint8_t> good;                  // per sample: 1 if the surface around it is one disc
  std::vector<std::array<Facing, 4>> facing;  // per cell and corner
  // For each sample, the lowest sample of its patch. All samples of a patch have their fronts on
  // the same side.
  std::vector<int32_t> patch;
  // per patch, at its lowest sample: 1 if it is a closed surface of good samples
  std::vector<uint8_t> closed;
};

// Marks the cells and joins samples to patches. Good samples mark the cells on the two sides of
// their umbrella, and other flat samples the cells that are well above or below their tangent
// plane. A patch joins first good samples that the surface connects, then flat ones whose normals
// agree, the best agreement first.
Marks mark(std::span<const Vec3> points, const Triangulation& triangulation, const Voronoi& voronoi,
           const Csr<int32_t>& incident, const Cocone& cocone, const FaceSet& front,
           const CoconeOptions& options, const Run& run);

}  // namespace medial
