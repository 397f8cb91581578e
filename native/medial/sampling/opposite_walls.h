// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the place of the opposite wall for a place of a surface: where the ball that touches the
// surface there from inside touches the faces that look the other way.
#pragma once

#include <optional>

#include "base/box_tree.h"
#include "sampling/pn_triangles.h"

namespace medial {

// A place of the opposite wall.
struct WallPlace {
  int32_t triangle = -1;
  Barycentric at{};
  double distance = 0;  // between the two places
};

// It reads the flat triangles. Its const members may be called from several threads.
class OppositeWalls {
 public:
  // The mesh must outlive this object; its triangles turn outward.
  explicit OppositeWalls(const TriangleMesh& mesh);

  // Returns the place at which the ball touches that touches the surface at `from`, where `normal`
  // is the outward unit normal, and lies inside. Only triangles within 30 degrees of the opposite
  // direction count, so the ball ignores walls beside. There is nothing if the diameter of the ball
  // is above `reach`, or if the ball touches the end of a wall at a slant.
  std::optional<WallPlace> operator()(const Vec3& from, const Vec3& normal, double reach) const;
  // Returns a place on the flat triangle.
  Vec3 point(int32_t triangle, const Barycentric& at) const;

 private:
  struct Node : TreeNode {
    Box box;
  };
  struct Touch {
    int32_t triangle = -1;
    Barycentric at{};
    Vec3 point;
  };

  Touch nearest_facing(const Vec3& centre, const Vec3& normal, double than) const;

  const TriangleMesh& mesh_;
  std::vector<int32_t> order_;  // triangles, leaf after leaf
  std::vector<Node> nodes_;
};

}  // namespace medial
