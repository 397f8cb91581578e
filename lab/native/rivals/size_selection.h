// SPDX-License-Identifier: GPL-3.0-or-later
// Selections by the length of Delaunay edges and the size of balls.
#pragma once

#include "axis/selection.h"

namespace medial {

//   angle_and_length  every ball of the facet sees pq under at least twice theta, and |pq| is at
//                     least `length` (after Attali & Lachaud 2001)
//   lambda            the nearest samples fit in no ball with a diameter below `length`, which is
//                     twice the lambda of Chazal & Lieutier (2005)
enum class SizeCondition : int32_t { angle_and_length = 0, lambda = 1 };

struct SizeExtraction {
  SizeCondition condition = SizeCondition::lambda;
  double length = 0.05;                 // at least 0; a share of the diagonal of the samples' box
  double theta = std::numbers::pi / 8;  // radians, 0 to pi/2
  Side side = Side::both;               // both, inner or outer
};

class SizeSelection : public Selection {
 public:
  // Throws as Selection does, also for a negative length.
  SizeSelection(const SizeExtraction& wanted, const Facets& facets);

  bool wants(int32_t edge, std::vector<int32_t>& ring) const override;
  double least_length() const { return least_length_; }

 private:
  double size(int32_t edge) const;
  bool is_seen_wide(int32_t edge, std::span<const int32_t> ring) const;

  SizeCondition condition_;
  double least_length_;
};

}  // namespace medial
