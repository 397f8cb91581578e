// SPDX-License-Identifier: GPL-3.0-or-later
// Slabs, cones and balls are the envelopes of balls whose centres move over a triangle, a segment
// or a point, with linear radii.
#pragma once

#include <array>
#include <span>

#include "base/vec3.h"

namespace medial {

// Distances below this share of the extent change nothing: a sheet is flat, a curve straight, and a
// triangle a line.
constexpr double kNoDistance = 0x1p-16;  // chosen: midsurface

struct Sphere {
  Vec3 centre;
  double radius = 0;
};

// Describes the ball of an envelope that is nearest to a query, by the shares of its spheres.
struct NearestOfEnvelope {
  double distance = HUGE_VAL;  // signed: negative inside that ball
  std::array<double, 3> shares{};
};

// Holds the envelope of 1 to 3 spheres, with what does not depend on a query.
class EnvelopeOfSpheres {
 public:
  EnvelopeOfSpheres() = default;
  explicit EnvelopeOfSpheres(std::span<const Sphere> spheres);

  // Returns the nearest ball. The distance to a ball is convex in its shares, so there is one
  // minimum.
  NearestOfEnvelope nearest(const Vec3& query) const;

 private:
  struct Cone {
    Vec3 along, axis;
    double rise = 0, whole = 0, ratio = 0, flat = 1;
    bool one_contains_other = true;
  };

  NearestOfEnvelope nearest_of_cone(int first, const Vec3& query) const;
  NearestOfEnvelope nearest_of_sides(const Vec3& query) const;
  NearestOfEnvelope nearest_of_slab(const Vec3& query) const;
  void prepare_cone(int first);

  int count_ = 0;
  std::array<Sphere, 3> spheres_;
  std::array<Cone, 3> cones_;  // from each sphere to the next
  bool has_planes_ = false;    // that are tangent to all three
  Vec3 u_, v_, n_, normal_, gradient_;
  double area_ = 0, flat_ = 1;
};

// Holds the outward normals of the two planes that are tangent to three spheres. There are none if
// one of the spheres, or a cone of two of them, contains the rest of the slab.
struct TangentNormals {
  bool exist = false;
  std::array<Vec3, 2> normals;
};
TangentNormals tangent_normals(const Sphere& a, const Sphere& b, const Sphere& c);

}  // namespace medial
