// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares the triangles of a mesh for sampling, and finds where its surface is not smooth: edges,
// corners, and the chains of edges between them.
#pragma once

#include "base/csr.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

// Angles that are closer are one, for coordinates come from float32.
inline constexpr double kAngleRounding = 1e-5;  // derived: rounding of a float

// Vertices with the same coordinates are one; every triangle is there once, in either orientation.
struct TriangleMesh {
  std::vector<Vec3> points;         // (v) distinct and used, in ascending order of `row`
  std::vector<int32_t> row;         // (v) lowest input row of each point
  std::vector<Triangle> triangles;  // (m) ids of points
  std::vector<int32_t> source;      // (m) input row of each triangle, ascending
  // (m) unit normals; a sliver has that of the triangle across its longest edge, or zero if there
  // is none
  std::vector<Vec3> normal;
  Csr<int32_t> fans;    // triangles at each point
  double rounding = 0;  // so far triangles of one plane are from it

  double corner_angle(int32_t triangle, int corner) const;
  // Returns the sum of the normals of the triangles at a point, weighted by their angles there.
  Vec3 normal_sum(int32_t point) const;
};

enum class Crease : uint8_t { none, sharp, boundary };

struct MeshEdge {
  Edge ends;               // p < q
  Edge triangles{-1, -1};  // the first two triangles at the edge
  Crease crease = Crease::none;
  bool manifold = false;  // whether two triangles have it, in opposite directions
};

inline int32_t other_end(const MeshEdge& edge, int32_t p) { return edge.ends[edge.ends[0] == p]; }

struct ChainLink {
  int32_t edge;
  bool reversed;  // whether it leads from q to p
};

struct Creases {
  double sharp_angle = 0;
  std::vector<MeshEdge> edges;      // in lexicographic order
  std::vector<int64_t> first_edge;  // (v + 1) edges by their lower end
  std::vector<Crease> at;           // (v) the sharpest of the edges there
  std::vector<uint8_t> corner;      // (v) whether the point is a corner
  Csr<ChainLink> chains;            // between corners; a chain without corners is closed

  int32_t find(int32_t p, int32_t q) const;
};

// Makes the mesh. Throws InvalidInputError for corners out of range and coordinates that are not
// finite.
TriangleMesh make_mesh(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                       const Run& run);

// Returns the edges between some rows of vertices as ids of points, without those of rows that no
// triangle uses. The mesh is that of the same vertices and triangles.
std::vector<Edge> marked_edges(std::span<const Vec3> vertices, std::span<const Edge> rows,
                               const TriangleMesh& mesh, std::span<const Triangle> triangles);

// Returns the edges of each triangle, by the corners from which they lead to the next one.
std::vector<std::array<int32_t, 3>> edges_of_triangles(const TriangleMesh& mesh,
                                                       const Creases& creases, const Run& run);

// Returns the edges that are creases, ascending.
std::vector<int32_t> crease_edges(const Creases& creases);

// Returns how many creases end at each point.
std::vector<int32_t> creases_at_points(const TriangleMesh& mesh, const Creases& creases);

// Finds the creases. An edge is sharp if its normals are `sharp_angle` or more apart, if it has
// more than two triangles, if two triangles have it in one direction, or if it is `marked` (by ids
// of points). A point is a corner if it ends other than two creases, or two that turn by more than
// the angle, or if it is the tip of a cone steeper than the angle. With `split_at_vertices`, chains
// end at every vertex.
Creases find_creases(const TriangleMesh& mesh, double sharp_angle, std::span<const Edge> marked,
                     bool split_at_vertices, const Run& run);

}  // namespace medial
