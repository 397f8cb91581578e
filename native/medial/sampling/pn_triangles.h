// SPDX-License-Identifier: GPL-3.0-or-later
// Represents the surface that is sampled: flat triangles, or PN triangles (Vlachos, Peters, Boyd &
// Mitchell 2001), which are cubic patches through the vertices with their normals.
#pragma once

#include "sampling/creases.h"

namespace medial {

struct Barycentric {
  double a, b, c;
};

// Returns the barycentric coordinates of a place on the edge between two corners of a triangle.
Barycentric along(const Triangle& t, int32_t from, int32_t to, double share);

// Holds a point of a patch, and its first and second derivatives by the coordinates b and c, where
// a is 1 - b - c.
struct PatchExpansion {
  Vec3 point, b, c, bb, bc, cc;
};

// A patch is a flat or cubic triangle.
class Patch {
 public:
  Patch(const Vec3& p, const Vec3& q, const Vec3& r) : corners_{p, q, r} {}
  // The handles are the inner control points of the edges: pq, qp, qr, rq, rp, pr, named by the
  // nearer corner first.
  Patch(const Vec3& p, const Vec3& q, const Vec3& r, const std::array<Vec3, 6>& handles);

  Vec3 point(const Barycentric& at) const;
  PatchExpansion expansion(const Barycentric& at) const;
  // Returns how far the patch is at most from its flat triangle.
  double bulge() const;
  // Returns a lower bound of the distance from a point to the patch: how far the patch is from it
  // at least along a unit direction from the patch to the point.
  double least_distance(const Vec3& from, const Vec3& direction) const;
  // Returns a box that holds the patch.
  Box box() const;

 private:
  std::array<Vec3, 3> corners_;
  bool flat_ = true;
  std::array<Vec3, 6> handles_;
  Vec3 centre_;
};

class CurvedSurface {
 public:
  // The mesh must outlive the surface. Normals are averages over smooth fans, weighted by angle.
  CurvedSurface(const TriangleMesh& mesh, const Creases& creases, bool smooth, const Run& run);

  bool smooth() const { return !handles_.empty(); }
  size_t bytes() const;
  const TriangleMesh& mesh() const { return mesh_; }
  Patch patch(int32_t triangle) const;
  Vec3 point(int32_t triangle, const Barycentric& at) const { return patch(triangle).point(at); }
  // Returns the unit normal, or zero if there is none.
  Vec3 normal(int32_t triangle, const Barycentric& at) const;

 private:
  // Holds the inner control points of an edge, next to p and next to q.
  using Handles = std::array<Vec3, 2>;

  void add_normals(const Creases& creases);
  void split_steep_fans(double sharp_angle);
  Handles handles_of(const MeshEdge& edge) const;
  const Vec3& fan_normal(int32_t triangle, int32_t vertex) const;
  const Vec3& handle(int32_t triangle, int from, int to) const;

  const TriangleMesh& mesh_;
  std::vector<Vec3> fan_normals_;               // per fan
  std::vector<std::array<int32_t, 3>> fan_of_;  // per triangle: the fan of each corner
  // per triangle: the edge from each corner to the next
  std::vector<std::array<int32_t, 3>> edge_of_;
  std::vector<Handles> handles_;  // per edge
};

}  // namespace medial
