// SPDX-License-Identifier: GPL-3.0-or-later
// Determines from the samples alone which poles are inside (Amenta, Choi & Kolluri 2001, sect. 5).
#pragma once

#include "axis/poles.h"
#include "inside/sides.h"

namespace medial {

// Holds values per sample. The poles of a sample on the surface are on two sides of the surface.
struct LabelledPoles {
  // Unit normals point outward along the pole vector; they are zero if both poles have no label, or
  // the same one. One label is enough, because thin walls hide many poles from each other.
  std::vector<Vec3> normals;
  // These are the cells of the inner and the outer pole if the two have different labels, else -1.
  // An outer pole at infinity is -1, too.
  std::vector<int32_t> inner, outer;
};

// Labels the poles one after another, starting with outer at infinity, the most certain one first.
// A label passes, reversed, to the opposite pole of a flat sample, with the cosine of the angle at
// the sample as certainty; and it passes unchanged to poles whose balls intersect deeply. At other
// samples both poles may be on the same side: at a sharp edge, or among outliers. `flat` is the
// value per sample that Cocone computes.
LabelledPoles labelled_poles(std::span<const Vec3> points, const Triangulation& triangulation,
                             const Voronoi& voronoi, const Csr<int32_t>& incident,
                             const Edges& edges, const Poles& poles, std::span<const uint8_t> flat,
                             const Run& run);

// Returns the share of the samples with two labels for which `sides` contradicts a label; 0 without
// such samples.
double disagreement(const LabelledPoles& poles, const CellSides& sides);

}  // namespace medial
