// SPDX-License-Identifier: GPL-3.0-or-later
// The options of an analysis have the published defaults of their methods.
#pragma once

#include <medial/types.h>

#include <numbers>

namespace medial {

// The source decides between inside and outside. Automatic takes the surface if it is closed, else
// normals if there are any, else Tight Cocone, or labels of the poles (Amenta, Choi & Kolluri 2001)
// if more than 5 % of them disagree with it.
enum class SidesFrom : int32_t { automatic = 0, surface, normals, tight_cocone, none, poles };

// Returns what Automatic takes before any poles are labelled; `bounded` says that the faces bound a
// solid.
constexpr SidesFrom automatic_sides(bool bounded, bool has_normals) {
  if (bounded) return SidesFrom::surface;
  return has_normals ? SidesFrom::normals : SidesFrom::tight_cocone;
}

// The rule says which ends of a Delaunay edge must pass a condition (Dey & Zhao, sect. 3).
enum class Rule : int32_t { either = 0, both = 1 };

// The criteria say which conditions select (Dey & Zhao, sect. 3.1 and 3.2).
enum class Criteria : int32_t { angle_or_ratio = 0, angle = 1, ratio = 2 };

// An edge passes the Angle condition if its theta is above this threshold, and Ratio likewise.
struct Thresholds {
  double theta = std::numbers::pi / 8;  // radians, 0 to pi/2
  double rho = 8;                       // at least 0
  Rule rule = Rule::either;
  Criteria criteria = Criteria::angle_or_ratio;
};

// An extraction says which facets are wanted.
struct Extraction {
  Thresholds thresholds = {};
  Side side = Side::both;  // both, inner or outer
  bool limit_set = false;  // Definition 4 for facets selected by the Ratio condition alone
};

// These are the constants of Cocone and Tight Cocone. Angles are in radians.
struct CoconeOptions {
  double cocone_angle = std::numbers::pi / 8;     // half-angle about the tangent plane
  double flatness_ratio = 1.2;                    // of a thin cell's width, at most its heights
  double flatness_angle = std::numbers::pi / 3;   // between the normal lines of cocone neighbours
  double sharp_angle = 2 * std::numbers::pi / 3;  // between the normals of triangles at an edge
};

}  // namespace medial
