// SPDX-License-Identifier: GPL-3.0-or-later
// The significance of edges by the Remark of Dey & Zhao (sect. 3.2).
#pragma once

#include "axis/poles.h"
#include "axis/significance.h"

namespace medial {

// The yardstick of the edges at a sample: the normals and the circumradii of its umbrella,
// as in MEDIAL; the pole vector in place of the normals; the reach of the tangent polygon in place
// of the circumradii; or both.
enum class Against : int32_t { umbrella = 0, pole = 1, polygon = 2, pole_and_polygon = 3 };

// By the pole vector, theta_p = asin(|v_p . pq| / (|v_p| |pq|)) for every edge, also those of the
// umbrella.
Significance significance_by_remark(std::span<const Vec3> points, const Edges& edges,
                                    const Umbrellas& umbrellas, const Poles& poles, Against against,
                                    const Run& run);

}  // namespace medial
