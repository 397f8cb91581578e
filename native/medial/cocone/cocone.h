// SPDX-License-Identifier: GPL-3.0-or-later
// Cocone: which samples are flat, and the candidate triangles of the surface through them (Amenta,
// Choi, Dey & Leekha 2002; flatness: Dey & Giesen 2001).
#pragma once

#include <medial/options.h>

#include "axis/poles.h"
#include "delaunay/face_set.h"

namespace medial {

// Throws InvalidInputError.
void require_valid(const CoconeOptions& options);

// Where a Voronoi vertex lies as seen from a sample.
enum class Zone : uint8_t { in_cocone, above, below };

// `towards`: from the sample to the Voronoi vertex; `normal`: its unit pole vector.
inline Zone zone_of(const Vec3& towards, const Vec3& normal, double sine_of_cocone_angle) {
  const double height = dot(towards, normal);
  if (!(std::abs(height) > sine_of_cocone_angle * length(towards))) return Zone::in_cocone;
  return height > 0 ? Zone::above : Zone::below;
}

struct Cocone {
  std::vector<Vec3> normal;  // per sample: its unit pole vector
  // Per sample. Thin: flatness_ratio times the distance of the farthest crossing of the Voronoi
  // cell's edges with the tangent plane is at most that of both poles. Flat: thin, and the normal
  // line agrees with those of all cocone neighbours; or with one that is flat.
  std::vector<uint8_t> thin, flat;
  // Triangles with a flat corner whose dual Voronoi edge meets the cocone of every flat corner;
  // from both sides.
  FaceSet candidates;
};

// The cocone of a sample p: all points y so that the line py makes at most cocone_angle with the
// plane through p normal to its pole vector. Its cocone neighbours: samples of the triangles at p
// whose dual Voronoi edge meets it.
Cocone cocone(std::span<const Vec3> points, const Triangulation& triangulation,
              const Voronoi& voronoi, const Csr<int32_t>& incident, const Poles& poles,
              const CoconeOptions& options, const Run& run);

}  // namespace medial
