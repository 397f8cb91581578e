// SPDX-License-Identifier: GPL-3.0-or-later
// Finds where the winding number of open triangles is one half, away from the triangles: on the
// surfaces that close the openings of the solid.
#pragma once

#include <optional>

#include "base/run.h"
#include "inside/winding_number.h"

namespace medial {

// Holds open triangles, and computes how often they wind around a place.
class OpenSurface {
 public:
  // The argument `boundary` is the result of boundary_edges.
  OpenSurface(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
              std::span<const Edge> boundary, const Progress* progress);

  // A fall is a segment on which the winding number falls through 1/2 without a triangle in
  // between: `share` is its approximate place on the way, and `above` is by how much the number
  // exceeds 1/2 at the inner end.
  struct Fall {
    Vec3 inside, outside;
    double share, above;

    Vec3 middle() const { return (1 - share) * inside + share * outside; }
  };
  // Returns the segments, one step long, on the axis-parallel lines of a lattice with spacing
  // `step`, that cross the level set. The search follows the level set from cube to cube of the
  // lattice, from the boundary edges on, because the level set ends only there and on the
  // triangles.
  std::vector<Fall> falls(double step, const Run& run) const;

  // Returns the place on a segment where the winding number is 1/2, within a millionth or two.
  // Returns nothing where the number jumps: two triangles may be so close together that the lattice
  // misses them.
  std::optional<Vec3> place(const Fall& fall) const;

  // Returns the outward unit normal of the level set through a place off the boundary edges, or
  // zero if it has none. The winding number is harmonic there, and the boundary alone determines
  // its gradient (Biot & Savart's law).
  Vec3 normal(const Vec3& place) const;

 private:
  friend class Follower;

  // Returns by how much the winding number exceeds 1/2, with an error of at most `tolerance`.
  double above(double tolerance, const Vec3& query, int closed_here) const {
    return winding_.within(tolerance, query, closed_here) - 0.5;
  }

  std::span<const Vec3> vertices_;
  std::span<const Edge> boundary_;
  WindingNumber winding_;
  RayCrossings triangles_;
};

}  // namespace medial
