// SPDX-License-Identifier: GPL-3.0-or-later
// The solid that balls or capsules are to cover: its surface, what is inside, and how deep.
#pragma once

#include <span>

#include "base/frame.h"
#include "base/rows.h"
#include "base/run.h"
#include "base/triangle_tree.h"
#include "inside/solid_lattice.h"
#include "inside/surface.h"

namespace medial {

inline constexpr double kPiece = 0.5;  // steps of the lattice: edges of pieces; chosen: balls

// The solid is kept in a frame in which squares of lengths do not overflow.
struct CoveredSolid {
  // The frame holds the vertices and `others`. Throws DegenerateInputError if the faces enclose
  // nothing.
  CoveredSolid(std::span<const Vec3> rows, std::span<const Triangle> faces,
               std::span<const Vec3> others, const Run& run);

  // Returns a lattice with about `places` places inside. Throws DegenerateInputError if there is
  // none.
  SolidLattice lattice(int64_t places, const Run& run) const;

  Frame frame;
  DistinctRows vertices;
  Surface surface;
  WindingNumber winding;
  Box box;
};

// Requires that at least one ball or capsule, and one place of the lattice, is asked for.
void require_amounts(int64_t count, int64_t places, double tolerance, const char* solid);

// It is safe to use from several threads. The solid must outlive it.
class SolidDepth {
 public:
  explicit SolidDepth(const CoveredSolid& solid)
      : winding_(solid.winding), tree_(solid.vertices.points, solid.surface.triangles) {}

  // Returns the distance from a place of the frame to the surface, negative outside.
  double at(const Vec3& place) const {
    const double away = tree_.distance(place);
    return winding_.is_inside(place, winding_.closed(place)) ? away : -away;
  }

 private:
  const WindingNumber& winding_;
  TriangleTree tree_;
};

}  // namespace medial
