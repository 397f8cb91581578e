// SPDX-License-Identifier: GPL-3.0-or-later
// Blue noise: discs on a surface, none with its centre inside another, and no room for one more.
#pragma once

#include "sampling/pieces.h"

namespace medial {

struct Disk {
  Vec3 centre;
  double radius;
  Vec3 normal;  // zero: it repels from all sides
};

struct PlacedDisk {
  Disk disk;
  Place place;
};

// Samples per area of squared radius, when the darts below have been thrown.
inline constexpr double kPacking = 0.61;

// Throws about `darts` times as many darts as will stay, spread evenly, in random order. One stays
// unless it is nearer to another disc, the `fixed` ones included, than the smaller of the radii and
// their normals are less than a right angle apart: opposite walls of a sheet do not repel each
// other. A disc's radius is `scale` times the spacing of its piece. Large discs are placed first.
std::vector<PlacedDisk> poisson_disks(const CurvedSurface& surface, std::span<const Piece> pieces,
                                      double scale, std::span<const Disk> fixed, int darts,
                                      uint64_t seed, const Run& run);

}  // namespace medial
