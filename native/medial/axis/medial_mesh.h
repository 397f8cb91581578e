// The closure of the selected Voronoi facets as a polygon mesh: output of MEDIAL(P).
#pragma once

#include "axis/selection.h"
#include "delaunay/samples.h"

namespace medial {

struct MedialMesh {
  Array<Vec3> vertices;          // (v) Voronoi vertices in order of first use; no two coincide
  Array<double> radius;          // (v) of the empty ball
  Array<int32_t> face_offsets;   // (f + 1)
  Array<int32_t> face_vertices;  // convex, counter-clockwise about p -> q, lowest id first
  Array<double> theta, rho;      // (f) as the rule takes them
  Array<Side> side;              // (f)
  Array<Edge> generators;        // (f) input rows p < q; the facets are in their order
  int64_t unbounded = 0;         // facets that reach infinity: counted, not emitted
  int64_t zero_area = 0;         // facets that are a point or a segment: not emitted
  int64_t rings = 0;             // of cells, walked to find all this
};

// The selected facets.
MedialMesh voronoi_facets(const Selection& selection, const Samples& samples,
                          const Triangulation& triangulation, const Voronoi& voronoi,
                          const Edges& edges, const Run& run);

}  // namespace medial
