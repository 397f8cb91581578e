// SPDX-License-Identifier: GPL-3.0-or-later
// Decides which vertices of a sphere mesh may merge if its sheets, curves and nodes shall stay.
#pragma once

#include "reduce/cone_and_slab.h"
#include "reduce/sphere_complex.h"

namespace medial {

class SheetLocks {
 public:
  // The labels must fit the complex.
  SheetLocks(const SphereComplex& complex, const SheetLabels& labels, size_t vertices);

  double shortest() const { return shortest_; }
  int32_t part(int32_t triangle) const { return part_[triangle]; }
  bool is_node(int32_t vertex) const { return node_[vertex] != 0; }
  bool is_on_curve(int32_t vertex) const { return curve_[vertex] != 0; }
  // Returns whether curves meet or end at a vertex.
  bool is_end(int32_t vertex) const {
    return is_node(vertex) || (is_on_curve(vertex) && curve_[vertex] != 2);
  }

  // Returns whether an edge belongs to a curve: not exactly two triangles of one sheet meet there.
  bool is_curve(const SphereComplex& complex, int32_t a, int32_t b) const;
  // Returns whether a vertex on a curve is at a sharp edge of the solid, where radii end in 0.
  bool is_sharp(int32_t vertex, const Sphere& sphere) const {
    return is_on_curve(vertex) && !(sphere.radius > kNoDistance);
  }
  // Returns whether a vertex may merge into another one that stays where it is. From a sharp edge
  // it does not go into the solid, which its tangent planes would allow.
  bool may_merge(const SphereComplex& complex, int32_t vertex, int32_t into,
                 std::span<const Sphere> spheres) const;
  // Returns whether the ends of an edge may merge at a third place: both are inside a sheet, or the
  // edge is one of their curve, and neither is at the end of a curve or at a sharp edge.
  bool may_move(const SphereComplex& complex, int32_t a, int32_t b,
                std::span<const Sphere> spheres) const;
  // Returns whether a triangle at an edge is a sheet by itself, which a collapse would take away.
  bool ends_sheet(const SphereComplex& complex, int32_t a, int32_t b) const;
  // Finds again which of a vertex and its neighbours are on curves, after a collapse.
  void update(const SphereComplex& complex, int32_t vertex);

 private:
  int32_t curve_edges(const SphereComplex& complex, int32_t vertex) const;

  double shortest_;
  std::vector<int32_t> part_;   // (t)
  std::vector<uint8_t> node_;   // (v)
  std::vector<int32_t> curve_;  // (v) how many edges of curves it has
};

}  // namespace medial
