// SPDX-License-Identifier: GPL-3.0-or-later
// The largest balls inside a solid that touch its faces at given places.
#pragma once

#include "walls/faces.h"

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
  double rounding = 0;  // so far coordinates may be off
};

struct InscribedBalls {
  std::vector<double> diameter;  // infinite where nothing is opposite
  // The same between walls: where the ball touches, as far as the surface is known, a place whose
  // normal differs by 120 degrees or more, or by 165 degrees; else infinite.
  std::vector<double> wall, parallel;
};

// Returns the ball that touches the faces at each place and has none of them inside. The faces are
// the whole boundary of a solid. The result does not depend on the order of the places.
InscribedBalls inscribed_balls(const Faces& faces, const FacePlaces& places, const Run& run);

// Returns the balls between walls to which the one at each place rolls, away from what it touches:
// in a square pin those of its middle line, at the narrow side of a plate those of the plate. They
// are infinite where a ball comes to rest between no walls.
InscribedBalls rolled_balls(const Faces& faces, const FacePlaces& places, const Run& run);

}  // namespace medial
