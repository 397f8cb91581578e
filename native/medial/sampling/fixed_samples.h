// SPDX-License-Identifier: GPL-3.0-or-later
// The samples that are placed before the blue noise: at corners, along creases, and next to them.
#pragma once

#include <medial/sampling.h>

#include <numbers>

#include "sampling/poisson_disk.h"

namespace medial {

// squared spacing if each sample has the area 1
inline constexpr double kHexagonal = 2 / std::numbers::sqrt3;  // derived: 2 / sqrt(3)
// The radius of a disc for a spacing is such that there are as many discs as points of the
// hexagonal lattice.
inline const double kDisk = std::sqrt(kPacking / kHexagonal);

struct FixedSample {
  SampleKind kind;
  int32_t triangle;
  Barycentric at;
  Vec3 point, normal;
  double radius;
  int32_t edge = -1;     // of the creases, or -1
  double share = 0;      // from the edge's first end
  int32_t partner = -1;  // on the opposite wall
};

FixedSample at_vertex(const CurvedSurface& surface, const Creases& creases, int32_t vertex,
                      const Spacing& spacing);
FixedSample on_edge(const CurvedSurface& surface, const Creases& creases, int32_t edge,
                    double share, const Spacing& spacing);
FixedSample on_surface(const CurvedSurface& surface, int32_t triangle, const Barycentric& at,
                       const Spacing& spacing);

// Returns the disc of a sample; those on creases and corners repel from all sides.
inline Disk disk_of(const FixedSample& s) {
  return {s.point, s.radius, s.kind >= SampleKind::vertex ? s.normal : Vec3{}};
}

}  // namespace medial
