// SPDX-License-Identifier: GPL-3.0-or-later
// This computes the significance of edges by the Remark of Dey & Zhao (sect. 3.2).
#pragma once

#include "axis/poles.h"
#include "axis/significance.h"

namespace medial {

// Edges at a sample are measured against the normals and circumradii of its umbrella, as in MEDIAL;
// against the pole vector instead of the normals; against the reach of the tangent polygon instead
// of the circumradii; or against both.
enum class Against : int32_t { umbrella = 0, pole = 1, polygon = 2, pole_and_polygon = 3 };

// With the pole vector, theta_p = asin(|v_p . pq| / (|v_p| |pq|)) for every edge, also those of the
// umbrella.
Significance significance_by_remark(std::span<const Vec3> points, const Edges& edges,
                                    const Umbrellas& umbrellas, const Poles& poles, Against against,
                                    const Run& run);

}  // namespace medial
