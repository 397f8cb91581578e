// SPDX-License-Identifier: GPL-3.0-or-later
// Makes blue noise: discs on a surface, none with its centre inside another one, and without room
// for one more.
#pragma once

#include "base/point_tree.h"
#include "sampling/opposite_walls.h"
#include "sampling/pieces.h"

namespace medial {

struct Disk {
  Vec3 centre;
  double radius;
  Vec3 normal;  // zero means that it repels from all sides
};

// Whether two discs repel each other, as those of opposite walls do not.
inline bool repel(const Disk& a, const Disk& b) {
  return a.normal == Vec3{} || b.normal == Vec3{} || dot(a.normal, b.normal) > 0;
}

// Returns whether a disc is not too near to any other one that counts. `centres` are those of all
// discs.
template <typename Counts>
bool has_room(std::span<const Disk> disks, size_t id, const PointTree& centres,
              const Counts& counts) {
  const Disk& disk = disks[id];
  std::vector<Neighbour> near;
  for (size_t count = 16;; count *= 4) {
    centres.find(disk.centre, count, near);
    for (const auto& [away, j] : near) {
      if (!counts(j) || !(away < std::min(disk.radius, disks[j].radius))) continue;
      if (repel(disk, disks[j])) return false;
    }
    if (near.size() < count || near.back().distance >= disk.radius) return true;
  }
}

struct PlacedDisk {
  Disk disk;
  int32_t triangle;
  Barycentric at;
  int to_partner = 0;  // where its partner on the opposite wall is in the list; 0: there is none
};

// Walls closer than this number of spacings get pairs of samples.
inline constexpr double kCloseWalls = 2;  // chosen: axis

// This is the number of samples per area of squared radius after the darts below have been thrown.
inline constexpr double kPacking = 0.61;  // measured: stage_sampling.md

// Throws about `darts` times as many darts as will stay, spread evenly, in random order. A dart
// stays unless it is nearer to another disc (including the `fixed` ones) than the smaller of the
// two radii, and their normals are less than a right angle apart: opposite walls of a sheet do not
// repel each other. The radius of a disc is `scale` times the spacing of its piece. Large discs are
// placed first. With `walls`, a dart between close walls takes its partner along: the disc of the
// same size at the place of the opposite wall, and so on through walls and gaps in turn. All of
// them stay or none does.
std::vector<PlacedDisk> poisson_disks(const CurvedSurface& surface, std::span<const Piece> pieces,
                                      double scale, std::span<const Disk> fixed, int darts,
                                      uint64_t seed, const Run& run,
                                      const OppositeWalls* walls = nullptr);

}  // namespace medial
