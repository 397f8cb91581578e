// SPDX-License-Identifier: GPL-3.0-or-later
// Marking: what every sample knows of its cells, the two sides of the surface there, and which
// samples know the same side (Dey & Goswami 2003).
#pragma once

#include "cocone/manifold.h"

namespace medial {

// On which side of the surface a cell lies, as one of its corners sees it; none: it cannot tell.
enum class Facing : uint8_t { none, front, back };

struct Marks {
  std::vector<uint8_t> good;                  // per sample: the surface is one disc round it
  std::vector<std::array<Facing, 4>> facing;  // per cell and corner
  // Per sample: the lowest one of its patch. All samples of a patch have their fronts on one side.
  std::vector<int32_t> patch;
  std::vector<uint8_t> closed;  // per patch, by its lowest sample: a whole surface of good samples
};

// Good samples tell the cells on the two sides of their umbrella, other flat samples those that lie
// well above or below their tangent plane. Patches: good samples that the surface connects, then
// flat ones whose normals agree, the best agreement first.
Marks mark(std::span<const Vec3> points, const Triangulation& triangulation, const Voronoi& voronoi,
           const Csr<int32_t>& incident, const Cocone& cocone, const FaceSet& front,
           const CoconeOptions& options, const Run& run);

}  // namespace medial
