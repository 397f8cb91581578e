// SPDX-License-Identifier: GPL-3.0-or-later
// Holds vertices, edges and triangles, and collapses edges if that keeps the homotopy type.
#pragma once

#include <medial/sphere_mesh.h>

#include <span>
#include <vector>

namespace medial {

class SphereComplex {
 public:
  explicit SphereComplex(const SphereMesh& mesh);

  // Returns the vertices that share an edge with the given one, ascending.
  std::span<const int32_t> neighbours(int32_t vertex) const { return neighbours_[vertex]; }
  // Returns the triangles of a vertex, ascending by number.
  std::span<const int32_t> triangles_of(int32_t vertex) const { return of_vertex_[vertex]; }
  const Triangle& triangle(int32_t id) const { return triangles_[id]; }
  int64_t triangle_count(int32_t a, int32_t b) const;  // of the edge ab

  // Returns whether the edge satisfies the link condition (Dey, Edelsbrunner, Guha & Nekhayev
  // 1999): all cells that are in the links of both ends are in the link of the edge. Then the
  // collapse keeps the homotopy type.
  bool can_collapse(int32_t a, int32_t b) const;
  // Merges `b` into `a`.
  void collapse(int32_t a, int32_t b);

 private:
  bool has_triangle(int32_t a, int32_t b, int32_t c) const;

  std::vector<Triangle> triangles_;
  std::vector<std::vector<int32_t>> neighbours_, of_vertex_;
};

}  // namespace medial
