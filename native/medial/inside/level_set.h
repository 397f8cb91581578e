// SPDX-License-Identifier: GPL-3.0-or-later
// Where the winding number of open triangles is one half away from the triangles: the surfaces that
// close the openings of the solid.
#pragma once

#include <optional>

#include "base/run.h"
#include "inside/winding_number.h"

namespace medial {

// Open triangles, and what tells how often they wind round a place.
class OpenSurface {
 public:
  // `boundary` as from boundary_edges.
  OpenSurface(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
              std::span<const Edge> boundary, const Progress* progress);

  // A piece of a line on which the winding number falls through 1/2 with no triangle in between,
  // about where, as a share of the way, and how far above 1/2 it is at its beginning.
  struct Fall {
    Vec3 inside, outside;
    double share, above;

    Vec3 middle() const { return (1 - share) * inside + share * outside; }
  };
  // The pieces, one step long, of the lines of a lattice along the axes, `step` apart, that cross
  // the level set. The search follows the level set from cube to cube of the lattice, beginning at
  // the boundary edges, because it ends only there and on the triangles.
  std::vector<Fall> falls(double step, const Run& run) const;

  // The place on a piece where the winding number is 1/2, within a millionth or two. Nothing where
  // it jumps: two triangles in between may be so close that the lattice does not see them.
  std::optional<Vec3> place(const Fall& fall) const;

  // The outward unit normal of the level set through a place off the boundary edges, zero where it
  // has none. The winding number is harmonic there, and the boundary alone tells its gradient (Biot
  // & Savart's law).
  Vec3 normal(const Vec3& place) const;

 private:
  friend class Follower;

  // How far the winding number is above 1/2, with an error of at most `tolerance`.
  double above(double tolerance, const Vec3& query, int closed_here) const {
    return winding_.within(tolerance, query, closed_here) - 0.5;
  }

  std::span<const Vec3> vertices_;
  std::span<const Edge> boundary_;
  WindingNumber winding_;
  RayCrossings triangles_;
};

}  // namespace medial
