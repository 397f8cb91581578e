// SPDX-License-Identifier: GPL-3.0-or-later
// Cocone decides which samples are flat, and selects the candidate triangles of the surface through
// them (Amenta, Choi, Dey & Leekha 2002; flatness: Dey & Giesen 2001).
#pragma once

#include <medial/options.h>

#include "axis/poles.h"
#include "delaunay/face_set.h"

namespace medial {

// Throws InvalidInputError for options out of range.
void require_valid(const CoconeOptions& options);

// The zone of a Voronoi vertex says where it is as seen from a sample.
enum class Zone : uint8_t { in_cocone, above, below };

// Returns the zone of a Voronoi vertex; `towards` leads from the sample to it, and `normal` is the
// unit pole vector of the sample.
inline Zone zone_of(const Vec3& towards, const Vec3& normal, double sine_of_cocone_angle) {
  const double height = dot(towards, normal);
  if (!(std::abs(height) > sine_of_cocone_angle * length(towards))) return Zone::in_cocone;
  return height > 0 ? Zone::above : Zone::below;
}

struct Cocone {
  std::vector<Vec3> normal;  // per sample: its unit pole vector
  // A sample is thin if flatness_ratio times the distance of the farthest crossing of its Voronoi
  // cell's edges with the tangent plane is at most the distance of both poles. It is flat if it is
  // thin, and its normal line agrees with those of all cocone neighbours or with that of a flat
  // one. Both are per sample.
  std::vector<uint8_t> thin, flat;
  // These triangles have a flat corner, and their dual Voronoi edge meets the cocone of every flat
  // corner. They are in the set from both sides.
  FaceSet candidates;
};

// Computes the cocones. The cocone of a sample p consists of all points y so that the line py makes
// at most cocone_angle with the plane through p normal to its pole vector. Its cocone neighbours
// are the samples of the triangles at p whose dual Voronoi edge meets the cocone.
Cocone cocone(std::span<const Vec3> points, const Triangulation& triangulation,
              const Voronoi& voronoi, const Csr<int32_t>& incident, const Poles& poles,
              const CoconeOptions& options, const Run& run);

}  // namespace medial
