// SPDX-License-Identifier: GPL-3.0-or-later
// The ordered collapse of the inner complex. An elementary collapse takes away a cell together with
// one of its faces, if no other cell has that face: it changes no homotopy type. So whatever is
// left over at any time has the topology of the solid. Stages, of which each ends when it can do no
// more:
//   0 bubbles  3-cells through a facet      samples inside the solid
//   1 fringe   facets that MEDIAL does not select through an edge; then edges through their loose
//              ends. What stays is MEDIAL's output with the bridges that it lacks: the complex K1.
//   2 fire     facets through an edge, in the order in which a fire that starts at the rims comes
//              to them
//   3 wires    edges through their loose ends, likewise
#pragma once

#include "base/atomic.h"
#include "skeleton/weight.h"

namespace medial {

inline constexpr int32_t kAlone = INT32_MIN;  // an edge that has not gone with anything
inline constexpr int32_t with_vertex(int32_t vertex) { return ~vertex; }

// The cells left at another one: how many, and the sum of their ids, of which the last one is
// known. Both in one number, which several threads can change at once.
class Incident {
 public:
  int32_t count() const { return static_cast<int32_t>(bits_ & kCount); }
  int32_t last() const { return static_cast<int32_t>(bits_ >> kShift); }  // of one
  // The other one of two, one of which is known.
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

  uint64_t bits_ = 0;  // the sum wraps round, which does not matter
};

// The cells that have gone, and the face with which each went.
struct Collapse {
  // Per edge, beside the arena: the facet that it went with, with_vertex(v) for the vertex, or
  // kAlone.
  Array<int32_t> partner;
  // Per vertex: the edge that it went with; -1: none.
  Array<int32_t> edge_of_vertex;
  Array<uint8_t> facet_gone;  // per facet: 1 once it has gone, or is about to
  Array<Incident> facets_at;  // per edge: those that are left
  Array<uint8_t> selected;    // per edge: it is a facet that MEDIAL selects; empty: none is

  bool edge_gone(int32_t edge) const { return partner[edge] != kAlone; }
  bool is_wire(int32_t edge) const { return facets_at[edge].count() == 0; }
  bool vertex_gone(int32_t vertex) const { return edge_of_vertex[vertex] >= 0; }
};

// Nothing has gone yet.
Collapse whole(const InnerComplex& complex, const FacetWeights& weight, const Run& run);

// Per vertex: the edges that are left at it.
Array<Incident> edges_left(const InnerComplex& complex, const Collapse& collapse, const Run& run);

inline int32_t other_end(const InnerComplex& complex, int32_t edge, int32_t vertex) {
  return complex.ends[edge][0] + complex.ends[edge][1] - vertex;
}

}  // namespace medial
