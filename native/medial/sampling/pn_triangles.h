// SPDX-License-Identifier: GPL-3.0-or-later
// Represents the surface that is sampled: flat triangles, or PN triangles (Vlachos, Peters, Boyd &
// Mitchell 2001), which are cubic patches through the vertices with their normals.
#pragma once

#include <span>

#include "sampling/creases.h"

namespace medial {

struct Barycentric {
  double a, b, c;
};

// Returns the place on the edge of a triangle between two of its corners, a share of the way from
// the first one.
Barycentric place_on_edge(const Triangle& t, const Edge& ends, double share);

// Holds a point of a patch, and its first and second derivatives by the coordinates b and c, where
// a is 1 - b - c.
struct PatchExpansion {
  Vec3 point, b, c, bb, bc, cc;
};

// A patch as a polynomial in b and c, which is fast to evaluate.
class PatchPolynomial {
 public:
  // The coefficients of 1, b, c, bb, bc, cc, bbb, bbc, bcc, ccc.
  using Coefficients = std::array<Vec3, 10>;

  explicit PatchPolynomial(const Coefficients& of) : of_(of) {}
  PatchExpansion expansion(double b, double c) const;

 private:
  Coefficients of_;
};

// A patch is a flat or cubic triangle.
class Patch {
 public:
  Patch(const Vec3& p, const Vec3& q, const Vec3& r) : controls_{p, q, r} {}
  // The handles are the inner control points of the edges: pq, qp, qr, rq, rp, pr, named by the
  // nearer corner first.
  Patch(const Vec3& p, const Vec3& q, const Vec3& r, const std::array<Vec3, 6>& handles);

  Vec3 point(const Barycentric& at) const;
  // Returns the patch relative to an origin.
  PatchPolynomial polynomial(const Vec3& origin) const;
  // Returns the control points, which hold the patch between them: the corners, and of a cubic
  // patch the handles and the one in the middle.
  std::span<const Vec3> controls() const { return {controls_.data(), flat_ ? size_t{3} : 10}; }
  // Returns how far the patch is at most from its flat triangle. A way along `free`, a unit vector
  // across that triangle, does not count, as it leads away from all points on the other side.
  double bulge(const Vec3& free = {}) const;
  // Returns a box that holds the patch.
  Box box() const;

 private:
  std::array<Vec3, 10> controls_;  // the corners, the handles, and the one in the middle
  bool flat_ = true;
};

// The normal at a vertex is a mean over the triangles of its fan, weighted by angle, which noise
// and uneven walls disturb least; or that of smooth_normal where a smooth fan leads round the
// vertex, which is closer to a smooth surface.
enum class VertexNormals : uint8_t { mean, fitted };

class CurvedSurface {
 public:
  // The mesh must outlive the surface.
  // Beside a bevel the normal is that of the wall, which stays flat.
  CurvedSurface(const TriangleMesh& mesh, const Creases& creases, bool smooth, const Run& run,
                VertexNormals normals = VertexNormals::mean);

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

  void add_normals(const Creases& creases, VertexNormals normals, const Run& run);
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
