// SPDX-License-Identifier: GPL-3.0-or-later
// Tight Cocone separates inside from outside for samples of a closed surface, and finds the
// watertight surface between them (Dey & Goswami 2003).
#pragma once

#include "cocone/marking.h"
#include "inside/sides.h"

namespace medial {

struct TightCocone {
  std::vector<uint8_t> flat, good;  // per sample
  CellSides sides;
  int64_t cavities = 0;  // closed sheets of good samples not reached from infinity
};

TightCocone tight_cocone(std::span<const Vec3> points, const Triangulation& triangulation,
                         const Voronoi& voronoi, const Csr<int32_t>& incident, const Poles& poles,
                         const CoconeOptions& options, const Run& run);

}  // namespace medial
