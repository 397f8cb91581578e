// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the solid angle of a triangle soup seen from a point, in full turns (over 4 pi): exactly
// by summation, or hierarchically with Taylor's remainder as a rigorous bound for the expansion of
// distant clusters (Barill et al. 2018).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box_tree.h"

namespace medial {

struct Corners {
  Vec3 a, b, c;
};

// Returns the sum over all triangles, in full turns.
double solid_angle_sum(std::span<const Corners> triangles, const Vec3& query);

// Reorders a range along the longest axis of its box, such that the lower half comes before the
// upper one; returns the middle.
int32_t split_in_half(std::vector<Corners>& corners, int32_t begin, int32_t end);

class SolidAngle {
 public:
  explicit SolidAngle(std::vector<Corners> triangles);

  double exact(const Vec3& query) const { return solid_angle_sum(corners_, query); }
  // Returns whether the exact value is below `bound`; opens clusters only until this is decided.
  bool is_below(double bound, const Vec3& query) const;
  // Returns the value with an error of at most `tolerance`; opens clusters only until this is
  // reached.
  double within(double tolerance, const Vec3& query) const;

 private:
  // A node is a contiguous range of triangles, expanded about its area-weighted centroid.
  struct Node : TreeNode {
    double area = 0, spread = 0;  // integral of dA, and of |x - centroid|^2 dA
    double radius = 0;            // of a ball about the centroid that contains the triangles
    Vec3 centroid, area_vector;   // area_vector: integral of n dA
    std::array<Vec3, 3> moment;   // moment[k] = integral of (x - centroid)_k n dA
  };
  // Holds the contribution of a node to the sum, and the bound of its error, both times 4 pi. The
  // bound is infinite if the node cannot be expanded.
  struct Term {
    double error, value;
    int32_t node;
  };

  void describe_leaf(Node& node) const;
  static void describe_parent(Node& node, const Node& left, const Node& right);
  int32_t split(int32_t begin, int32_t end);
  void find_radius(Node& node) const;
  Term term(int32_t id, const Vec3& query) const;
  template <typename Enough>
  double opened(const Vec3& query, const Enough& enough) const;

  std::vector<Corners> corners_;
  std::vector<Node> nodes_;
};

}  // namespace medial
