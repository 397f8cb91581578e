// SPDX-License-Identifier: GPL-3.0-or-later
// Stores the solid of a sphere mesh as a tree of slabs, cones and balls, to find their nearest
// ball.
#pragma once

#include <medial/sphere_mesh.h>

#include <span>
#include <vector>

#include "base/box_tree.h"
#include "reduce/cone_and_slab.h"

namespace medial {

// A part is a slab, a cone or a ball, by the number of its vertices, which are followed by -1.
using Part = std::array<int32_t, 3>;

// Returns all slabs, the cones of wires, and the balls of vertices without an edge.
std::vector<Part> parts_of(const SphereMesh& mesh);

// Several threads may use it at once, except for refit().
class Envelope {
 public:
  // The mesh must have a vertex and must outlive this object. Its spheres may move; see refit.
  explicit Envelope(const SphereMesh& mesh);

  struct Found {
    NearestOfEnvelope nearest;
    int32_t part = -1;
  };
  // Finds the nearest ball; `near` is a part that is probably nearby, which saves time, or -1.
  Found find(const Vec3& query, int32_t near = -1) const;

  // Returns whether a ball of a part contains the query more than `depth` deep.
  bool covers(const Vec3& query, double depth) const;

  std::span<const Part> parts() const { return parts_; }
  // Returns the nearest ball of one part.
  NearestOfEnvelope nearest_in(int32_t part, const Vec3& query) const;
  // Updates the tree after the spheres have moved, and prepares the parts for many queries.
  void refit();

 private:
  struct Node : TreeNode {
    Box box;  // of the centres
    double largest = 0;
  };

  void measure(Node& node) const;
  bool covers_in(int32_t id, const Vec3& query, double limit) const;
  // Returns a lower bound of the distance to a part, much sooner than the distance.
  double part_bound(int32_t part, const Vec3& query) const;
  EnvelopeOfSpheres of_part(int32_t part) const;
  static double bound(const Node& node, const Vec3& query);

  const SphereMesh& mesh_;
  std::vector<Part> parts_;  // leaf after leaf
  std::vector<Node> nodes_;
  std::vector<EnvelopeOfSpheres> prepared_;  // of the parts, or empty
};

}  // namespace medial
