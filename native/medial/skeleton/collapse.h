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

#include "skeleton/weight.h"

namespace medial {

inline constexpr int32_t kAlone = INT32_MIN;  // an edge that has not gone with anything
inline constexpr int32_t with_vertex(int32_t vertex) { return ~vertex; }

// How many cells are left at another, and all of their ids by exclusive or: of the last one its id.
struct Incident {
  int32_t count = 0, ids = 0;

  void add(int32_t id) { ++count, ids ^= id; }
  void remove(int32_t id) { --count, ids ^= id; }
  void add_shared(int32_t id) { change_shared(1, id); }
  void remove_shared(int32_t id) { change_shared(-1, id); }

 private:
  void change_shared(int32_t by, int32_t id) {
    std::atomic_ref(count).fetch_add(by, std::memory_order_relaxed);
    std::atomic_ref(ids).fetch_xor(id, std::memory_order_relaxed);
  }
};

// What has gone, and with which face.
struct Collapse {
  // Per edge: the facet that it went with, with_vertex(v) for the vertex, or kAlone.
  Array<int32_t> partner;
  // Per vertex: the edge that it went with; -1: none.
  Array<int32_t> edge_of_vertex;
  Array<uint8_t> facet_gone;  // per facet: 1 once it has gone, or is about to
  Array<Incident> facets_at;  // per edge: those that are left
  Array<uint8_t> selected;    // per edge: it is a facet that MEDIAL selects; empty: none is

  bool edge_gone(int32_t edge) const { return partner[edge] != kAlone; }
  bool is_wire(int32_t edge) const { return facets_at[edge].count == 0; }
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
