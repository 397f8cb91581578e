// Cells without extent drawn together, by steps that each keep the topology: an edge without length
// shrinks to a point unless it closes a loop; a facet that is left with one edge shrinks to a point
// with it; a facet that is left with two edges shrinks to one edge, unless both are the same already.
#pragma once

#include "skeleton/complex.h"

namespace medial {

// Which cells of a complex are there.
struct Alive {
  Array<uint8_t> facet, edge, vertex;
};

struct Drawing {
  // The lowest of those that have become one with it.
  Array<int32_t> vertex, edge;
  Array<uint8_t> drawn_facet;  // 0: not alive, or shrunk
  Array<uint8_t> drawn_edge;   // 0: not alive, shrunk, or not the lowest
};

Drawing draw(const InnerComplex& complex, const Alive& alive, const Run& run);

}  // namespace medial
