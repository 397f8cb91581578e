// SPDX-License-Identifier: GPL-3.0-or-later
// Which poles lie inside, told from the samples alone (Amenta, Choi & Kolluri 2001, sect. 5).
#pragma once

#include "axis/poles.h"
#include "inside/sides.h"

namespace medial {

// Per sample. The poles of a sample on the surface lie on two sides of it.
struct LabelledPoles {
  // Unit, outward, along the pole vector; zero where the two poles have no label, or the same. One
  // label is enough: thin walls hide many poles from each other.
  std::vector<Vec3> normals;
  // The cells with the inner and the outer one where the two have different labels, else -1. An
  // outer pole at infinity is -1, too.
  std::vector<int32_t> inner, outer;
};

// The poles are labelled one after another, outward in at infinity, the surest first. A label goes
// on to the opposite pole of a flat sample, turned round, by the cosine of the angle at the sample;
// and unturned to poles whose balls deeply intersect. Elsewhere the two poles of a sample may lie
// on one side: at a sharp edge, or among outliers. `flat`: per sample, as Cocone tells it.
LabelledPoles labelled_poles(std::span<const Vec3> points, const Triangulation& triangulation,
                             const Voronoi& voronoi, const Csr<int32_t>& incident,
                             const Edges& edges, const Poles& poles, std::span<const uint8_t> flat,
                             const Run& run);

// The share of samples with both labels one of whose poles lies elsewhere by `sides`; 0 for none.
double disagreement(const LabelledPoles& poles, const CellSides& sides);

}  // namespace medial
