// The closure of the selected Voronoi facets as a polygon mesh: output of MEDIAL(P).
#pragma once

#include "complex.h"
#include "selection.h"
#include "sides.h"

namespace medial {

struct MedialMesh {
  std::vector<Vec3> vertices;         // (v) Voronoi vertices in order of first use; no two coincide
  std::vector<double> radius;         // (v) of the empty ball
  std::vector<int32_t> face_offsets;  // (f + 1)
  std::vector<int32_t> face_vertices;  // convex, counter-clockwise about p -> q, lowest id first
  std::vector<double> theta, rho;      // (f) as the rule takes them
  std::vector<Side> side;              // (f)
  std::vector<Edge> generators;        // (f) input rows p < q
  int64_t unbounded = 0;               // facets that reach infinity: counted, not emitted
  int64_t zero_area = 0;               // facets that are a point or a segment: not emitted
};

// Polygons with vertices and radii; the attributes are the caller's.
struct Facets {
  MedialMesh mesh;
  std::vector<int32_t> edges;  // (f) the edge of each emitted facet
};

// The dual facets of `edge_ids`, in that order.
Facets voronoi_facets(std::span<const int32_t> edge_ids, std::span<const Vec3> points,
                      const Triangulation& triangulation, const Voronoi& voronoi,
                      const Edges& edges, const Run& run);

}  // namespace medial
