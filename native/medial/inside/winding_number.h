// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the generalized winding number of a triangle soup (Jacobson, Kavan, Sorkine-Hornung
// 2013): the solid angle of all triangles, in full turns.
//
// Caps close the soup: triangles from the edges of each boundary loop to its middle. The winding
// number of the closed soup is an integer, which the crossings of any ray determine; that of the
// few caps is summed. The result is their difference.
#pragma once

#include <span>

#include "inside/boundary.h"
#include "inside/ray_crossings.h"

namespace medial {

// Returns the corners of the triangles, except for triangles with a repeated corner.
std::vector<Corners> soup(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

class WindingNumber {
 public:
  // The argument `boundary` is the result of boundary_edges.
  WindingNumber(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                std::span<const Edge> boundary, const Progress* progress);

  double operator()(const Vec3& query) const;

  // Returns the winding number of the soup with its caps.
  int closed(const Vec3& query) const;
  // Returns the same, computed from the triangles between `query` and a point where it is known.
  int closed_from(const Vec3& known, int closed_there, const Vec3& query) const;
  // Computes the same at places in a row, each a `step` farther than the last in the direction of
  // x.
  void closed_along(const Vec3& first, double step, std::span<int> result) const;
  // Returns whether the winding number of the soup itself exceeds 1/2; sums the caps only until
  // this is decided.
  bool is_inside(const Vec3& query, int closed_here) const;
  // Returns whether the winding number exceeds 1/2 all along a segment. It is computed between
  // every two triangles that the segment meets, and in at least eight places, because for an open
  // soup it varies.
  bool is_inside_along(const Vec3& from, const Vec3& to) const;
  // Returns the winding number of the soup itself, with an error of at most `tolerance`.
  double within(double tolerance, const Vec3& query, int closed_here) const {
    return closed_here - caps_.within(tolerance, query);
  }

 private:
  WindingNumber(std::vector<Corners> soup, std::vector<Corners> caps, const Progress* progress);

  RayCrossings crossings_;  // of the soup with its caps
  SolidAngle caps_;
};

}  // namespace medial
