// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles of a mesh made fit for sampling, and where its surface is not smooth: edges,
// corners, and the chains of edges between them.
#pragma once

#include "base/csr.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

// Vertices with the same coordinates are one; every triangle is there once, whichever way round.
struct TriangleMesh {
  std::vector<Vec3> points;         // (v) distinct and used, in ascending order of `row`
  std::vector<int32_t> row;         // (v) lowest input row of each
  std::vector<Triangle> triangles;  // (m) ids of points
  std::vector<int32_t> source;      // (m) input row of each, ascending
  std::vector<Vec3> normal;         // (m) unit; of a sliver, which has none of its own, that across
                                    // its longest edge; zero when there is none either
  Csr<int32_t> fans;                // triangles at each point

  double corner_angle(int32_t triangle, int corner) const;
  // Sum of the normals of the triangles at a point, weighted by their angles there.
  Vec3 normal_sum(int32_t point) const;
};

enum class Crease : uint8_t { none, sharp, boundary };

struct MeshEdge {
  Edge ends;               // p < q
  Edge triangles{-1, -1};  // the first two
  Crease crease = Crease::none;
  bool manifold = false;  // two triangles that pass it in opposite directions
};

struct ChainLink {
  int32_t edge;
  bool reversed;  // passed from q to p
};

struct Creases {
  double sharp_angle = 0;
  std::vector<MeshEdge> edges;      // in lexicographic order
  std::vector<int64_t> first_edge;  // (v + 1) edges by their lower end
  std::vector<Crease> at;           // (v) of the edges there the sharpest
  std::vector<uint8_t> corner;      // (v)
  Csr<ChainLink> chains;            // between corners; a chain without corner is closed

  int32_t find(int32_t p, int32_t q) const;
};

// Throws InvalidInputError for corners out of range and coordinates that are not finite.
TriangleMesh make_mesh(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                       const Run& run);

// Sharp are edges whose normals are `sharp_angle` or more apart, edges of more than two triangles,
// edges passed twice in one direction, and those `marked` (ids of points). Corners end other than
// two creases, or two that turn by more than the angle, or are the tip of a cone steeper than it.
// `split_at_vertices`: chains end at every vertex.
Creases find_creases(const TriangleMesh& mesh, double sharp_angle, std::span<const Edge> marked,
                     bool split_at_vertices, const Run& run);

}  // namespace medial
