// SPDX-License-Identifier: GPL-3.0-or-later
// The inner Voronoi complex D: what of the Voronoi diagram lies inside, with all that it consists
// of. Its dual are the simplices in the interior of the solid, so it has the solid's topology.
//   vertices  the inner finite cells              edges    the triangles between two of them
//   facets    the Delaunay edges all of whose     3-cells  the samples all of whose cells
//             cells are inner                              are inner
// Of cospherical samples, the cells without extent are shrunk to what they are.
#pragma once

#include "delaunay/edges.h"
#include "delaunay/samples.h"
#include "inside/sides.h"

namespace medial {

// A vertex of a facet, and the edge that leads from it to the next one.
struct Corner {
  int32_t vertex, edge;
};

// A facet without area and the edge that it is, or -1 and the vertex.
struct ShrunkFacet {
  Edge generators;
  int32_t dual, edge, vertex;
};

struct InnerComplex {
  // Vertices in the order of their cells, of several in one place the lowest cell.
  Array<int32_t> cell;
  Array<Vec3> position;
  Array<double> radius;

  Array<Edge> ends;  // of the edges: vertices, the lower one first

  // Facets in the order of their Delaunay edges.
  Array<Edge> generators;  // samples; the one with the lower row first
  Array<int32_t> dual;     // position of the Delaunay edge in the analysis; empty after it
  Array<int32_t> offsets;  // (facets + 1) into the corners
  Array<Corner> corners;   // counter-clockwise about the direction between the generators

  Array<ShrunkFacet> shrunk;
  Array<int32_t> bubbles;  // the samples that are 3-cells, ascending
  double diagonal = 0;     // of the box of the samples

  int32_t vertices() const { return static_cast<int32_t>(cell.size()); }
  int32_t edges() const { return static_cast<int32_t>(ends.size()); }
  int32_t facets() const { return static_cast<int32_t>(generators.size()); }
  std::span<const Corner> ring(int32_t facet) const {
    return {corners.data() + offsets[facet],
            static_cast<size_t>(offsets[facet + 1] - offsets[facet])};
  }
};

// `sides` are known. The complex lies in memory of its own, beside the arena of `run`.
InnerComplex inner_complex(const Samples& samples, const Triangulation& triangulation,
                           const Voronoi& voronoi, const Edges& edges, const CellSides& sides,
                           const Run& run);

}  // namespace medial
