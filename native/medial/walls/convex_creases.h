// SPDX-License-Identifier: GPL-3.0-or-later
// The sharp convex edges of the faces, which the medial axis reaches with balls of radius 0. They
// divide the faces into patches. On a coarse mesh of a smooth body edges are sharp here and there
// without dividing anything; zigzags of short edges stand for a smooth line.
#pragma once

#include "walls/faces.h"

namespace medial {

struct PlaceOnCrease {
  int32_t edge = -1;  // of the mesh
  double share = 0;   // from the edge's first end
  Vec3 point;
  double distance = HUGE_VAL;
};

// Its const members may be called from several threads.
class ConvexCreases {
 public:
  // The faces must outlive this object. Patches of less than about a hundred squares of `spacing`,
  // a length of the samples, belong to the neighbour with the longest common border, and bends
  // closer to each other than a few spacings are no corners.
  ConvexCreases(const Faces& faces, double spacing);

  bool empty() const { return segments_.empty(); }
  // Returns the nearest place of the creases if it is nearer than a distance.
  std::optional<PlaceOnCrease> nearer(const Vec3& from, double than) const;
  // Returns whether a vertex of the mesh is an end or a bend of convex creases.
  bool is_corner(int32_t vertex) const { return corner_[vertex] != 0; }
  // Returns whether an edge is part of a zigzag, or near to one.
  bool is_jagged(int32_t edge) const { return jagged_[edge] != 0; }
  // Returns whether an edge is one of a few that hang together and divide nothing, by accident
  // sharp.
  bool is_fragment(int32_t edge) const { return fragment_[edge] != 0; }
  // Returns whether the two sides of an edge are different patches.
  bool divides(int32_t edge) const { return divides_[edge] != 0; }

 private:
  // Returns the patch of each triangle.
  std::vector<int32_t> find_patches(double spacing);
  void find_corners(std::span<const int32_t> patch, double spacing);
  void find_zigzags(std::span<const Vec3> bends, double spacing);
  void find_fragments(double spacing);
  bool meets_three(int32_t vertex, std::span<const int32_t> patch) const;
  PlaceOnCrease place_on(int32_t edge, const Vec3& from) const;

  const Faces& faces_;
  std::vector<int32_t> segments_;  // edges of the mesh, leaf after leaf
  std::vector<uint8_t> corner_;    // per vertex
  std::vector<uint8_t> divides_;   // per edge
  std::vector<uint8_t> jagged_;    // per edge
  std::vector<uint8_t> fragment_;  // per edge
  std::vector<BoxNode> nodes_;
};

}  // namespace medial
