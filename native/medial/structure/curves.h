// SPDX-License-Identifier: GPL-3.0-or-later
// The curves of an axis: seams between its sheets, rims, and creases.
#pragma once

#include "structure/parts.h"

namespace medial {

// Shorter curves count for nothing, and places that are closer are one, in spacings.
inline constexpr double kShortCurve = 1.5;  // chosen: axis

struct AxisCurve {
  CurveKind kind = CurveKind::none;
  std::vector<int32_t> parts;  // ascending
  double length = 0, spacing = 0, radius = 0, least_radius = 0;
  Vec3 middle;

  bool is_long() const;
};

struct AxisCurves {
  std::vector<CurveKind> kind;    // (e)
  std::vector<int32_t> of_edge;   // (e) -1 where none
  std::vector<AxisCurve> curves;  // in the order of their first edges
  Csr<int32_t> at_vertex;         // edges of curves at each vertex
};

// Finds the curves: edges of one kind between the same parts that are connected.
AxisCurves curves_of(const Facets& facets, const AxisParts& parts, const Run& run);

// Measures the curves again, after `of_edge` has joined some; unused numbers disappear.
void measure_curves(const Facets& facets, AxisCurves& curves);

}  // namespace medial
