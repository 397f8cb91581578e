// SPDX-License-Identifier: GPL-3.0-or-later
// Makes samples that close the openings of a surface: blue noise on the level set 1/2 of its
// winding number, away from the triangles.
#pragma once

#include "sampling/poisson_disk.h"

namespace medial {

struct ClosingSamples {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  // outward
  std::vector<double> radius;
};

// Returns samples among the discs `kept` of the surface itself, with the same distances as in
// poisson_disks. A disc has the radius of the nearest kept disc plus a share of its distance. There
// are no samples if the triangles are closed, or nothing is kept.
ClosingSamples closing_samples(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                               std::span<const Disk> kept, uint64_t seed, const Run& run);

}  // namespace medial
