// SPDX-License-Identifier: GPL-3.0-or-later
// A solid is approximated by few capsules round segments, such as the edges of a small medial mesh.
#pragma once

#include <medial/ball_cover.h>

namespace medial {

// The input is the segments, and the solid that the capsules round them are to cover.
struct CapsuleCoverInput {
  std::span<const Vec3> places;     // ends of segments
  std::span<const Edge> segments;   // rows of `places`; both may be the same one
  std::span<const Vec3> vertices;   // of the surface of the solid
  std::span<const Triangle> faces;  // outward, rows of `vertices`
  // At both ends of each segment: with `around`, what capsules begin with; empty where they begin
  // with the largest that fit in the solid.
  std::span<const double> radii;
};

struct CapsuleCoverOptions {
  int64_t count = 64;  // most capsules that are kept, those of the largest volume
  CoverMode mode = CoverMode::inside;
  bool tapered = true;       // radii may differ at both ends
  int64_t places = 100'000;  // of the lattice in the solid, as for balls
  // With `inside`, capsules that leave something out may grow until they reach out so far.
  double tolerance = 0;
};

// A capsule is the union of the balls round the places of a segment, with linear radii.
struct CapsuleCover {
  std::vector<Vec3> ends;     // (2n) both ends of each capsule, the largest volume first
  std::vector<double> radii;  // (2n)
  double held = 0;            // share of the places of the lattice that the capsules hold
  double outside = 0;         // no place in a capsule is farther from the solid
  double farthest = 0;        // no place on the surface is farther from the capsules
  int64_t places = 0;
  double step = 0;  // spacing of the lattice
};

// Capsules round groups of places: the ends 2k and 2k + 1 are those of group k.
struct LeastCapsules {
  std::vector<Vec3> ends;
  std::vector<double> radii;
};

// Returns, for each group, a capsule of nearly the least volume that holds its places; radii of an
// empty group are 0. Throws InvalidInputError.
LeastCapsules least_capsules(std::span<const Vec3> places, std::span<const int32_t> group,
                             int32_t count, bool tapered, int threads = 0);

// Makes the capsules. With `inside`, each is the largest that was found round its segment and stays
// in the solid, or a ball round one end if that is larger. With `around`, each, or that of the
// given radii, grows or shrinks until it just holds the parts of the surface, and the places
// inside, that are nearest to it. `threads` 0 means all cores; the result does not depend on it.
// Throws InvalidInputError, DegenerateInputError if the faces enclose no place or no capsule lies
// in the solid, Cancelled.
CapsuleCover cover_by_capsules(const CapsuleCoverInput& input,
                               const CapsuleCoverOptions& options = {}, int threads = 0,
                               Progress* progress = nullptr);

}  // namespace medial
