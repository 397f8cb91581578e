// SPDX-License-Identifier: GPL-3.0-or-later
// The largest balls inside a solid that touch its faces at given places.
#pragma once

#include "contact/faces.h"

namespace medial {

// Each array has one row per place.
struct FacePlaces {
  std::span<const Vec3> points;  // on the faces
  // Rows of the triangles of the input; -1 if it is unknown.
  std::span<const int32_t> triangle;
  // Closer than this to a place, and closer than its triangle is wide if that is curved, faces that
  // look almost as it does are the place itself.
  std::span<const double> spacing;
  // Unit, outward; at a place with a zero normal there is no ball. Without normals, the places are
  // moved to the smooth surface of their triangles and have its normals.
  std::span<const Vec3> normals = {};
};

struct InscribedBalls {
  std::vector<double> diameter;  // infinite where nothing is opposite
  // The same between walls: where the ball touches, up to 3 % of its radius, a place whose normal
  // differs by 120 degrees or more, the one that does; else infinite.
  std::vector<double> wall;
};

// Returns the ball that touches the faces at each place and has none of them inside. The faces are
// the whole boundary of a solid. The result does not depend on the order of the places.
InscribedBalls inscribed_balls(const Faces& faces, const FacePlaces& places, const Run& run);

}  // namespace medial
