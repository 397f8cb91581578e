// The ordered collapse of the inner complex. An elementary collapse takes away a cell together with
// one of its faces, if no other cell has that face: it changes no homotopy type. So whatever is left
// over at any time has the topology of the solid. Stages, of which each ends when it can do no more:
//   0 bubbles  3-cells through a facet      samples inside the solid
//   1 fringe   facets that MEDIAL does not select through an edge; then edges through their loose
//              ends. What stays is MEDIAL's output with the bridges that it lacks: the complex K1.
//   2 fire     facets through an edge, in the order in which a fire that starts at the rims comes
//              to them
//   3 wires    edges through their loose ends, likewise
#pragma once

#include "skeleton/complex.h"

namespace medial {

inline constexpr int32_t kAlone = INT32_MIN;  // an edge that has not gone with anything
inline constexpr int32_t with_vertex(int32_t vertex) { return ~vertex; }

// What has gone, and with which face.
struct Collapse {
  // Per edge: the facet that it went with, with_vertex(v) for the vertex, or kAlone.
  Array<int32_t> partner;
  // Per vertex: the edge that it went with; -1: none.
  Array<int32_t> edge_of_vertex;
  Array<uint8_t> facet_gone;  // per facet: 1 once it has gone, or is about to
  // Per edge: how many facets are left at it, and all of their ids by exclusive or: the id of the
  // last one.
  Array<uint8_t> degree;
  Array<int32_t> facets_at;

  bool edge_gone(int32_t edge) const { return partner[edge] != kAlone; }
  bool vertex_gone(int32_t vertex) const { return edge_of_vertex[vertex] >= 0; }
};

// Nothing has gone yet.
Collapse whole(const InnerComplex& complex, const Run& run);

// How many edges are left at each vertex, and all of their ids by exclusive or.
struct Ends {
  Array<uint8_t> degree;
  Array<int32_t> edges_at;
};
Ends ends_left(const Collapse& collapse, const EdgesAtVertex& edges_at, const Run& run);

inline int32_t other_end(const InnerComplex& complex, int32_t edge, int32_t vertex) {
  return complex.ends[edge][0] + complex.ends[edge][1] - vertex;
}

}  // namespace medial
