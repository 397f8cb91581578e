// SPDX-License-Identifier: GPL-3.0-or-later
// The sharp convex edges of the faces, which the medial axis reaches with balls of radius 0.
#pragma once

#include "contact/faces.h"

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
  // The faces must outlive this object.
  explicit ConvexCreases(const Faces& faces);

  bool empty() const { return segments_.empty(); }
  // Returns the nearest place of the creases if it is nearer than a distance.
  std::optional<PlaceOnCrease> nearer(const Vec3& from, double than) const;
  // Returns whether a vertex of the mesh is an end or a bend of convex creases.
  bool is_corner(int32_t vertex) const { return corner_[vertex] != 0; }
  // Returns whether some convex crease ends at a vertex or passes it.
  bool is_on_crease(int32_t vertex) const { return on_crease_[vertex] != 0; }

 private:
  struct Node : TreeNode {
    Box box;
  };

  PlaceOnCrease place_on(int32_t edge, const Vec3& from) const;

  const Faces& faces_;
  std::vector<int32_t> segments_;  // edges of the mesh, leaf after leaf
  std::vector<uint8_t> corner_, on_crease_;
  std::vector<Node> nodes_;
};

}  // namespace medial
