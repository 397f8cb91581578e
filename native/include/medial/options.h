// SPDX-License-Identifier: GPL-3.0-or-later
// What one may ask for, and the defaults of those who published the methods.
#pragma once

#include <medial/types.h>

#include <numbers>

namespace medial {

// What tells inside from outside. Automatic: the surface when it is closed, else normals when there
// are any, else Tight Cocone, or labels of the poles (Amenta, Choi & Kolluri 2001) where more than
// 5 % of them disagree with it.
enum class SidesFrom : int32_t { automatic = 0, surface, normals, tight_cocone, none, poles };

// Which ends of a Delaunay edge must pass a condition (Dey & Zhao, sect. 3).
enum class Rule : int32_t { either = 0, both = 1 };

// Which conditions select: those of Dey & Zhao (sect. 3.1 and 3.2), or of others on the same
// facets.
//   angle_and_length  every ball of the facet sees pq under at least twice theta, and |pq| is at
//                     least `length` (after Attali & Lachaud 2001)
//   lambda            the nearest samples fit in no ball with a diameter below `length`, which is
//                     twice the lambda of Chazal & Lieutier (2005)
enum class Criteria : int32_t {
  angle_or_ratio = 0,
  angle = 1,
  ratio = 2,
  angle_and_length = 3,
  lambda = 4
};

// What the edges at a sample are measured against: the normals and the circumradii of its umbrella,
// or, as in the Remark in sect. 3.2, the pole vector for the normals, the reach of the tangent
// polygon for the circumradii, or both.
enum class Against : int32_t { umbrella = 0, pole = 1, polygon = 2, pole_and_polygon = 3 };

// Of the conditions: an edge passes Angle when its theta is above this one, Ratio likewise.
struct Thresholds {
  double theta = std::numbers::pi / 8;  // radians, 0 to pi/2
  double rho = 8;                       // at least 0
  Rule rule = Rule::either;
  Criteria criteria = Criteria::angle_or_ratio;
  double length = 0.05;  // at least 0; a share of the diagonal of the samples' box
};

// Which facets are wanted.
struct Extraction {
  Thresholds thresholds = {};
  Side side = Side::both;  // both, inner or outer
  bool limit_set = false;  // Definition 4 for facets selected by the Ratio condition alone
};

// The constants of Cocone and Tight Cocone. Angles in radians.
struct CoconeOptions {
  double cocone_angle = std::numbers::pi / 8;     // half-angle about the tangent plane
  double flatness_ratio = 1.2;                    // of a thin cell's width, at most its heights
  double flatness_angle = std::numbers::pi / 3;   // between the normal lines of cocone neighbours
  double sharp_angle = 2 * std::numbers::pi / 3;  // between the normals of triangles at an edge
};

}  // namespace medial
