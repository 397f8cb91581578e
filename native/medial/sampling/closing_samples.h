// SPDX-License-Identifier: GPL-3.0-or-later
// Samples that close the openings of a surface: blue noise on the level set 1/2 of its winding
// number, off the triangles.
#pragma once

#include "sampling/poisson_disk.h"

namespace medial {

struct ClosingSamples {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  // outward
  std::vector<double> radius;
};

// Among the discs that are kept of the surface itself, with the same distances as in poisson_disks.
// A disc is as large as the nearest one of those, and larger by a share of its distance. None where
// the triangles are closed, or nothing is kept.
ClosingSamples closing_samples(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                               std::span<const Disk> kept, uint64_t seed, const Run& run);

}  // namespace medial
