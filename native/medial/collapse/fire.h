// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 2 of the collapse is a fire that starts at the rims of K1 and spreads with unit speed. A
// point on a rim catches fire after a time that is the radius of its ball. Where three sheets meet,
// the fire waits for the second sheet (Yan, Sykes, Chambers, Letscher & Ju 2016). The erosion
// thickness of a facet is how much later than the radius of the ball at its centroid the fire comes
// there.
#pragma once

#include <functional>

#include "collapse/collapse.h"

namespace medial {

// The width of the first range of a queue of fire, as a share of the diagonal.
inline constexpr double kFirstRange = 1.0 / 1024;  // work: time

// Holds the times at the ends of an edge, in the order of its ends.
using Times = std::array<double, 2>;

struct Burning {
  // For each edge, when it became free; for an edge that never had a facet in K1, the radii. The
  // times mean nothing for edges that are not free at the end.
  Array<Times> times;
  Array<uint8_t> is_wire;  // per edge: 1 if it has no facet left
  // For each facet, its erosion thickness: infinite if it did not burn, 0 if it is not in K1.
  Array<double> thickness;
  // The same value, but never less than that of a facet that had to be removed before.
  Array<float> erosion;  // as shares of the diagonal
};

// Returns the radius of the ball at a place in a facet.
using RadiusInFacet = std::function<double(int32_t facet, const Vec3& place)>;

// Returns the radii of the balls that touch `points`, the samples; both must outlive the result.
RadiusInFacet radius_by(const InnerComplex& complex, std::span<const Vec3> points);

// Removes all facets that the fire can reach; the rest are closed sheets. Empties
// `collapse.facets_at`.
Burning burn(const InnerComplex& complex, const RadiusInFacet& radius, Collapse& collapse,
             const Run& run);

}  // namespace medial
