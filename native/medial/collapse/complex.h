// SPDX-License-Identifier: GPL-3.0-or-later
// The inner Voronoi complex D is the part of the Voronoi diagram inside the solid, with all its
// faces. It is dual to the simplices in the interior of the solid, so it has the topology of the
// solid.
//   vertices  the inner finite cells              edges    the triangles between two of them
//   facets    the Delaunay edges all of whose     3-cells  the samples all of whose cells
//             cells are inner                              are inner
// Cells without extent, which cospherical samples cause, are shrunk to points or edges.
#pragma once

#include "delaunay/edges.h"
#include "delaunay/samples.h"
#include "inside/sides.h"

namespace medial {

// A corner is a vertex of a facet, and the edge that leads from it to the next vertex.
struct Corner {
  int32_t vertex, edge;
};

// A shrunk facet has no area; it became the edge, or the vertex if `edge` is -1.
struct ShrunkFacet {
  Edge generators;
  int32_t dual, edge, vertex;
};

struct InnerComplex {
  // Vertices are in the order of their cells; for several cells in one place it is the lowest one.
  // The last ones are in the middle of edges with the ends of another one, and have the cell of
  // one.
  Array<int32_t> cell;
  Array<Vec3> position;
  Array<double> radius;

  Array<Edge> ends;  // per edge: its vertices, the lower one first

  // Facets are in the order of their Delaunay edges.
  Array<Edge> generators;  // samples, the one with the lower row first
  Array<int32_t> dual;     // index of the Delaunay edge in the analysis; empty afterwards
  Array<int32_t> offsets;  // (facets + 1) into the corners
  Array<Corner> corners;   // counter-clockwise about the direction between the generators

  Array<ShrunkFacet> shrunk;
  Array<int32_t> bubbles;  // the samples that are 3-cells, ascending
  Array<Edge> merged;      // pairs of a vertex and a further cell in its place, ascending
  double diagonal = 0;     // of the bounding box of the samples

  int32_t vertices() const { return static_cast<int32_t>(cell.size()); }
  int32_t edges() const { return static_cast<int32_t>(ends.size()); }
  int32_t facets() const { return static_cast<int32_t>(generators.size()); }
  std::span<const Corner> ring(int32_t facet) const {
    return {corners.data() + offsets[facet],
            static_cast<size_t>(offsets[facet + 1] - offsets[facet])};
  }
};

// Builds the complex; all `sides` must be decided. The complex is not in the arena of `run`.
InnerComplex inner_complex(const Samples& samples, const Triangulation& triangulation,
                           const Voronoi& voronoi, const Edges& edges, const CellSides& sides,
                           const Run& run);

}  // namespace medial
