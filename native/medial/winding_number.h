// Generalized winding number of a triangle soup (Jacobson, Kavan, Sorkine-Hornung 2013), summed hierarchically with a
// rigorous bound (Taylor expansion of distant clusters as in Barill et al. 2018, with its remainder).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vec3.h"

namespace medial {

using Triangle = std::array<int32_t, 3>;

class WindingNumber {
 public:
  WindingNumber(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

  // Within 0.1 of the sum of all solid angles over 4 pi, and on its side of 1/2.
  double operator()(const Vec3& query) const;

 private:
  struct Corners {
    Vec3 a, b, c;
  };
  // A contiguous range of triangles, expanded about its area-weighted centroid.
  struct Node {
    int32_t begin = 0, end = 0;
    int32_t right = -1;          // the left child follows its parent; -1: a leaf
    double area = 0, spread = 0; // integral of dA, and of |x - centroid|^2 dA
    double radius = 0;           // of a ball about the centroid that holds the triangles
    Vec3 centroid, area_vector;  // area_vector: integral of n dA
    std::array<Vec3, 3> moment;  // moment[k] = integral of (x - centroid)_k n dA
  };
  struct Sum {
    double value = 0, error = 0;  // both times 4 pi
  };

  int32_t build(int32_t begin, int32_t end);
  void describe_leaf(Node& node) const;
  void describe_parent(Node& node, const Node& left, const Node& right) const;
  Sum evaluate(const Vec3& query, double tolerance) const;

  std::vector<Corners> corners_;
  std::vector<Node> nodes_;
};

}  // namespace medial
