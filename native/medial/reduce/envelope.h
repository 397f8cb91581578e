// SPDX-License-Identifier: GPL-3.0-or-later
// The solid of a sphere mesh as a tree of slabs, cones and balls: which of their balls comes
// nearest.
#pragma once

#include <medial/sphere_mesh.h>

#include <span>
#include <vector>

#include "reduce/cone_and_slab.h"

namespace medial {

// A slab, a cone or a ball, by the number of its vertices; -1 behind them.
using Part = std::array<int32_t, 3>;

// All slabs, the cones of wires, and the balls of vertices without an edge.
std::vector<Part> parts_of(const SphereMesh& mesh);

// Safe to use from several threads.
class Envelope {
 public:
  // The mesh must outlive it, and its spheres may move: see refit. There is one vertex at least.
  explicit Envelope(const SphereMesh& mesh);

  struct Found {
    NearestOfEnvelope nearest;
    int32_t part = -1;
  };
  // `near` is a part that is probably among the nearest, which makes it quicker; -1: not known.
  Found find(const Vec3& query, int32_t near = -1) const;

  // Whether a ball of a part holds the query more than `depth` deep.
  bool covers(const Vec3& query, double depth) const;

  std::span<const Part> parts() const { return parts_; }
  // The nearest of the balls of one part.
  NearestOfEnvelope nearest_in(int32_t part, const Vec3& query) const;
  // After the spheres have moved.
  void refit();

 private:
  struct Node {
    Box box = {};  // of the centres
    double largest = 0;
    int32_t begin = 0, end = 0;
    int32_t right = -1;  // the left child follows its parent; -1: a leaf
  };

  int32_t build(int32_t begin, int32_t end);
  void measure(Node& node) const;
  void search(int32_t id, const Vec3& query, Found& best) const;
  static double bound(const Node& node, const Vec3& query);

  const SphereMesh& mesh_;
  std::vector<Part> parts_;  // leaf after leaf
  std::vector<Node> nodes_;
};

}  // namespace medial
