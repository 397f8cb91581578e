// SPDX-License-Identifier: GPL-3.0-or-later
// Generalized winding number of a triangle soup (Jacobson, Kavan, Sorkine-Hornung 2013): the solid
// angle of all triangles, in full turns.
//
// Caps, triangles from the edges of each boundary loop to its middle, close the soup. The winding
// number of the closed soup is an integer, told by the crossings of any ray; that of the few caps
// is summed. Their difference is the answer.
#pragma once

#include <span>

#include "inside/boundary.h"
#include "inside/ray_crossings.h"

namespace medial {

// The corners of the triangles, but for those with a repeated one.
std::vector<Corners> soup(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

class WindingNumber {
 public:
  // `boundary` as from boundary_edges.
  WindingNumber(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                std::span<const Edge> boundary, const Progress* progress);

  double operator()(const Vec3& query) const;

  // Winding number of the soup with its caps.
  int closed(const Vec3& query) const;
  // The same, told by what lies between `query` and a point where it is known.
  int closed_from(const Vec3& known, int closed_there, const Vec3& query) const;
  // Whether the winding number of the soup itself exceeds 1/2; the caps are summed only as far as
  // it takes to tell.
  bool is_inside(const Vec3& query, int closed_here) const;
  // Whether that exceeds 1/2 all along a segment: it is looked at between each two triangles that
  // the segment meets and, because that of an open soup varies there, at eight places at least.
  bool is_inside_along(const Vec3& from, const Vec3& to) const;
  // The winding number of the soup itself, with an error of at most `tolerance`.
  double within(double tolerance, const Vec3& query, int closed_here) const {
    return closed_here - caps_.within(tolerance, query);
  }

 private:
  WindingNumber(std::vector<Corners> soup, std::vector<Corners> caps, const Progress* progress);

  RayCrossings crossings_;  // of the soup with its caps
  SolidAngle caps_;
};

}  // namespace medial
