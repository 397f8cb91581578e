// SPDX-License-Identifier: GPL-3.0-or-later
// The medial axis is a polygon mesh: the closure of the selected Voronoi facets.
#pragma once

#include <medial/types.h>

namespace medial {

// The polygons are convex and planar, and share their vertices.
struct MedialMesh {
  Column<Vec3> vertices;          // (v) Voronoi vertices in order of first use; no two coincide
  Column<double> radius;          // (v) radius of the empty ball
  Column<int32_t> face_offsets;   // (f + 1) facet i has the corners from the i-th of these on
  Column<int32_t> face_vertices;  // convex, counter-clockwise about p -> q, lowest id first
  Column<double> theta, rho;      // (f) as combined by the rule
  Column<Side> side;              // (f)
  Column<Edge> generators;        // (f) input rows p < q; the facets are in their order
  Column<Edge> edges;             // (e) ends of the edges without a facet; MEDIAL has none
  int64_t unbounded = 0;          // facets that reach infinity: counted, not emitted
  int64_t zero_area = 0;          // a point or a segment, within 2^-40 of a ball: not emitted
  int64_t rings = 0;              // rings of cells walked on the way
};

}  // namespace medial
