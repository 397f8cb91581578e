// SPDX-License-Identifier: GPL-3.0-or-later
// The creases of a mesh as straight segments, and the place of them that is nearest to a point.
#pragma once

#include <optional>

#include "base/box_tree.h"
#include "sampling/creases.h"

namespace medial {

struct PlaceOnLine {
  int32_t edge = -1;  // of the creases
  double share = 0;   // from the edge's first end
  double distance = HUGE_VAL;
};

// Its const members may be called from several threads.
class CreaseLines {
 public:
  // Both must outlive this object.
  CreaseLines(const TriangleMesh& mesh, const Creases& creases);

  // Returns the nearest place if it is not farther than a distance.
  std::optional<PlaceOnLine> nearest(const Vec3& from, double within) const;

 private:
  std::optional<PlaceOnLine> place_on(int32_t edge, const Vec3& from) const;

  const TriangleMesh& mesh_;
  const Creases& creases_;
  std::vector<int32_t> order_;  // edges, leaf after leaf
  std::vector<BoxNode> nodes_;
};

}  // namespace medial
