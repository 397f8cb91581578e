// How often a ray leaves a triangle soup, minus how often it enters: for a closed soup its winding number at the origin.
#pragma once

#include <optional>

#include "progress.h"
#include "solid_angle.h"

namespace medial {

class RayCrossings {
 public:
  RayCrossings(std::vector<Corners> triangles, const Progress* progress);

  // Nothing when the ray passes so close to an edge that doubles cannot tell on which side.
  std::optional<int> operator()(const Vec3& origin, const Vec3& direction) const;
  std::span<const Corners> triangles() const { return corners_; }

 private:
  struct Node {
    Box box;
    int32_t begin = 0, end = 0;
    int32_t right = -1;  // the left child follows its parent; -1: a leaf
  };

  int32_t build(int32_t begin, int32_t end, const Progress* progress);

  std::vector<Corners> corners_;
  std::vector<Node> nodes_;
};

}  // namespace medial
