// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh of triangles in which any number of triangles may meet at an edge, with wires: edges that
// belong to no triangle. It changes by collapses, flips and splits of edges that keep its topology
// and its strata: sheets, the curves in which sheets meet or end, and the nodes of the curves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/triangle.h"

namespace medial {

// The stratum of a vertex, by its link. Round a vertex inside a sheet it is one circle. On a curve,
// which is a seam or a rim, it is some arcs, all of which have the same two ends; one arc on a rim.
// Every other vertex is a node, and so is one at which a wire ends, or that is said to be one.
enum class Stratum : uint8_t { sheet, curve, node };

// The former numbers of the vertices and triangles that are left, ascending, and the new number of
// each former vertex, or -1.
struct Kept {
  std::vector<int32_t> vertices, triangles, number;
};

// `triangles_at`, `can_collapse` and what calls them may not be called from several threads at
// once.
class SheetComplex {
 public:
  // No two triangles have the same corners. No wire has the same ends as another or as an edge of a
  // triangle.
  SheetComplex(int32_t vertices, std::vector<Triangle> triangles, std::span<const Edge> wires,
               std::span<const uint8_t> is_node);

  int32_t vertices() const { return static_cast<int32_t>(first_.size()); }
  int32_t triangles() const { return static_cast<int32_t>(triangles_.size()); }
  const Triangle& triangle(int32_t t) const { return triangles_[t]; }
  // A triangle is gone after the collapse of one of its edges.
  bool is_gone(int32_t t) const { return triangles_[t][0] < 0; }
  // A vertex inside the mesh is gone after its collapse; at a vertex of wires nothing is gone.
  bool has_triangles(int32_t v) const { return first_[v] >= 0; }
  Stratum stratum(int32_t v) const { return stratum_[v]; }
  // Returns whether a vertex is a node that is never collapsed nor moved by smoothing: the end of a
  // wire, or one that was said to be a node.
  bool stays(int32_t v) const { return stays_[v] != 0; }
  // Makes a node of a vertex, which stays where it is.
  void make_node(int32_t v) {
    stratum_[v] = Stratum::node;
    stays_[v] = 1;
  }

  // Calls found(triangle) for the triangles at a vertex.
  template <typename Found>
  void for_triangles(int32_t v, const Found& found) const {
    for (int32_t c = first_[v]; c >= 0; c = next_[c]) found(c / 3);
  }
  // Calls found(vertex) for the two other corners of each triangle at a vertex.
  template <typename Found>
  void for_corners(int32_t v, const Found& found) const {
    for_triangles(v, [&](int32_t t) {
      for (const int32_t other : link_of(triangles_[t], v)) found(other);
    });
  }
  // Returns the number of triangles at an edge.
  int uses(int32_t a, int32_t b) const;
  bool is_inside_sheet(int32_t a, int32_t b) const { return uses(a, b) == 2; }
  // Returns the triangles at an edge, in no particular order.
  const std::vector<int32_t>& triangles_at(int32_t a, int32_t b) const;
  // Returns the other triangle at an edge of two triangles, or -1 where there are not two.
  int32_t across(int32_t t, int32_t a, int32_t b) const;
  int32_t third_corner(int32_t t, int32_t a, int32_t b) const {
    const Edge others = link_of(triangles_[t], a);
    return others[0] == b ? others[1] : others[0];
  }
  // Returns the neighbours of a vertex along edges that are not inside a sheet, ascending.
  std::vector<int32_t> curve_neighbours(int32_t v) const;
  // Returns the two neighbours of a vertex on a curve along it.
  Edge along_curve(int32_t v) const;
  bool is_rim(int32_t v) const {
    return stratum_[v] == Stratum::curve && uses(v, along_curve(v)[0]) == 1;
  }
  // Returns the edges of the triangles, lower vertex first, in lexicographic order.
  std::vector<Edge> edges() const;

  // Returns whether the mesh keeps its topology and its strata if a vertex is moved along an edge
  // to the other end of it: the link condition, and a vertex leaves no higher stratum. What is
  // smaller than an edge may go: two nodes become one along the curve between them, and a sheet of
  // a single triangle becomes a curve.
  bool can_collapse(int32_t from, int32_t to) const;
  // Returns whether the mesh keeps its topology if two vertices of one place become one: they have
  // an edge between them, or an edge each to one common neighbour. The first is not inside a sheet,
  // and no wire ends at them.
  bool can_unite(int32_t from, int32_t to) const;
  // Replaces a vertex by another one, where one of the two above says that it can be.
  void collapse(int32_t from, int32_t to);

  // Returns whether an edge inside a sheet can be replaced by the other diagonal of its two
  // triangles.
  bool can_flip(int32_t a, int32_t b) const;
  // The first one of triangles_at(a, b) gives up `b` and the second one `a`; they stay turned as
  // they are.
  void flip(int32_t a, int32_t b);

  // Divides an edge by a new vertex, which is returned. Of each triangle at the edge, the half at
  // `a` keeps its number; split_off[i] is the other half of triangles_at(a, b)[i].
  int32_t split(int32_t a, int32_t b, std::vector<int32_t>& split_off);

  // Returns whether a triangle can be added on the edges from one corner to the two others, between
  // which there is no edge: an elementary expansion, which keeps the homotopy type.
  bool can_add(int32_t corner, int32_t a, int32_t b) const {
    return uses(corner, a) > 0 && uses(corner, b) > 0 && uses(a, b) == 0 && !is_wired(a, b);
  }
  void add(const Triangle& triangle);

  // Numbers what is left anew, in the same order, without what is gone.
  Kept compact();

 private:
  Stratum find_stratum(int32_t v) const;
  bool link_is_circle(int32_t v) const;
  bool link_is_arcs(int32_t v, int32_t from, int32_t to) const;
  bool loses_sheet(int32_t from, int32_t to) const;
  bool links_have_in_common(int32_t from, int32_t to, int at_edge) const;
  bool ends_wire(int32_t v) const;
  bool is_wired(int32_t a, int32_t b) const;
  bool has_triangle(int32_t a, int32_t b, int32_t c) const;
  // Adds or removes a corner, 3 * triangle + place, to or from the list of its vertex.
  void link(int32_t corner);
  void unlink(int32_t corner);
  int32_t append(const Triangle& triangle);
  void replace_corner(int32_t t, int32_t from, int32_t to);

  std::vector<Triangle> triangles_;
  std::vector<int32_t> first_, next_, before_;  // per vertex and corner: the list of corners; or -1
  std::vector<Stratum> stratum_;                // kept by nearly all changes
  std::vector<uint8_t> stays_;  // per vertex: whether it is a node that is never collapsed
  std::vector<Edge> wires_;     // both ways, ascending
  mutable std::vector<int32_t> at_edge_;  // result of triangles_at
  mutable std::vector<uint32_t> mark_;    // per vertex, in can_collapse
  mutable uint32_t newest_mark_ = 0;
};

}  // namespace medial
