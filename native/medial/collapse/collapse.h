// SPDX-License-Identifier: GPL-3.0-or-later
// This is the ordered collapse of the inner complex. An elementary collapse removes a cell together
// with one of its faces, if no other cell has that face; it does not change the homotopy type. So
// the cells that are left at any time have the topology of the solid. Each stage ends when it can
// remove nothing more:
//   0 bubbles  removes 3-cells (of samples inside the solid) through a facet
//   1 fringe   removes facets that MEDIAL does not select through an edge, then edges through their
//              loose ends. The rest, the complex K1, is MEDIAL's output with the missing bridges.
//   2 fire     removes facets through an edge, in the order in which a fire that starts at the
//              rims reaches them
//   3 wires    removes edges through their loose ends, in the same way
#pragma once

#include "base/atomic.h"
#include "collapse/weight.h"

namespace medial {

inline constexpr int32_t kAlone = INT32_MIN;  // marks an edge that was not removed with a cell
inline constexpr int32_t with_vertex(int32_t vertex) { return ~vertex; }

// Holds the number of cells that are left at another cell, and the sum of their ids, which
// identifies the last one. Both are in one number, which several threads can change at once.
class Incident {
 public:
  int32_t count() const { return static_cast<int32_t>(bits_ & kCount); }
  int32_t last() const { return static_cast<int32_t>(bits_ >> kShift); }  // valid if one is left
  // Returns the other one of the two cells that are left.
  int32_t other_than(int32_t id) const {
    return static_cast<int32_t>((bits_ - with(id)) >> kShift);
  }

  void add(int32_t id) { bits_ += with(id); }
  void remove(int32_t id) { bits_ -= with(id); }
  void add_shared(int32_t id) { shared_add(bits_, with(id)); }
  void remove_shared(int32_t id) { shared_add(bits_, ~with(id) + 1); }

 private:
  static constexpr int kShift = 24;
  static constexpr uint64_t kCount = (1u << kShift) - 1;

  static uint64_t with(int32_t id) { return (static_cast<uint64_t>(id) << kShift) + 1; }

  uint64_t bits_ = 0;  // the sum wraps round, which does no harm
};

// Records the cells that were removed, and the face with which each was removed.
struct Collapse {
  // For each edge, the facet that it was removed with, with_vertex(v) for the vertex, or kAlone.
  // This array is not in the arena.
  Array<int32_t> partner;
  // For each vertex, the edge that it was removed with, or -1.
  Array<int32_t> edge_of_vertex;
  Array<uint8_t> facet_gone;  // per facet: 1 if it is removed, or about to be
  Array<Incident> facets_at;  // per edge: the facets that are left at it
  // per edge: 1 if a selected facet shrank to it; empty if no facet shrank
  Array<uint8_t> selected;

  bool edge_gone(int32_t edge) const { return partner[edge] != kAlone; }
  bool is_wire(int32_t edge) const { return facets_at[edge].count() == 0; }
  bool vertex_gone(int32_t vertex) const { return edge_of_vertex[vertex] >= 0; }
};

// Returns a collapse in which nothing is removed yet.
Collapse whole(const InnerComplex& complex, const FacetWeights& weight, const Run& run);

// Returns for each vertex the edges that are left at it.
Array<Incident> edges_left(const InnerComplex& complex, const Collapse& collapse, const Run& run);

inline int32_t other_end(const InnerComplex& complex, int32_t edge, int32_t vertex) {
  return complex.ends[edge][0] + complex.ends[edge][1] - vertex;
}

}  // namespace medial
