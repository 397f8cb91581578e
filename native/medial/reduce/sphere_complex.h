// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices, edges and triangles, in which edges collapse as long as that keeps the homotopy type.
#pragma once

#include <medial/sphere_mesh.h>

#include <span>
#include <vector>

namespace medial {

class SphereComplex {
 public:
  explicit SphereComplex(const SphereMesh& mesh);

  // The vertices that have an edge with one, ascending.
  std::span<const int32_t> neighbours(int32_t vertex) const { return neighbours_[vertex]; }
  // The triangles of a vertex, ascending by number.
  std::span<const int32_t> triangles_of(int32_t vertex) const { return of_vertex_[vertex]; }
  const Triangle& triangle(int32_t id) const { return triangles_[id]; }
  int64_t triangle_count(int32_t a, int32_t b) const;  // of those on an edge

  // The link condition (Dey, Edelsbrunner, Guha & Nekhayev 1999): what is in the links of both ends
  // is in the link of the edge. Then what is left has the homotopy type of what was there.
  bool can_collapse(int32_t a, int32_t b) const;
  // Puts `b` into `a`.
  void collapse(int32_t a, int32_t b);

 private:
  bool has_triangle(int32_t a, int32_t b, int32_t c) const;

  std::vector<Triangle> triangles_;
  std::vector<std::vector<int32_t>> neighbours_, of_vertex_;
};

}  // namespace medial
