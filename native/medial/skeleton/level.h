// A level of the hierarchy: the cells whose values are above some thresholds, as a mesh of
// polygons, edges that stand by themselves, and single vertices.
#pragma once

#include "skeleton/betti.h"
#include "skeleton/values.h"

namespace medial {

// What a cell has to exceed to stay. A cell stays if it exceeds the first three, or the last one;
// and all stay that the collapse left.
struct LevelThresholds {
  double sheet = 0;     // thickness of its sheet, as a share of the diagonal
  double spacings = 0;  // the same in local spacings of the samples
  double erosion = 0;   // of the facet itself, as a share of the diagonal
  double limb = 0.04;   // of vertices and edges alone: length of its branch, likewise
};

// What the levels of a complex are made from.
struct Hierarchical {
  InnerComplex complex;
  Array<int32_t> partner;  // as in Collapse
  Values values;
  Array<float> limb;         // per vertex
  std::vector<int32_t> row;  // of the samples
  Array<int32_t> outside;    // as from outside_components
};

struct Level {
  Array<Vec3> vertices;          // (v) in order of first use
  Array<double> radius;          // (v) of the empty ball
  Array<int32_t> vertex_of;      // (v) of the complex
  Array<int32_t> face_offsets;   // (f + 1)
  Array<int32_t> face_vertices;  // convex, counter-clockwise about p -> q
  Array<Edge> generators;        // (f) input rows p < q; the facets are in their order
  Array<int32_t> facet_of;       // (f) of the complex
  Array<Edge> wires;             // (w) edges without a facet: vertices
  Array<int32_t> edge_of;        // (w) of the complex
  Array<int32_t> points;         // (k) vertices without an edge
  Betti betti = {};              // counted on all this
  int64_t hidden = 0;            // edges from a vertex to itself, and facets with fewer than three
                                 // other edges: they count, but cannot be drawn
};

// Throws InvalidInputError for thresholds below 0.
Level level(const Hierarchical& hierarchy, const LevelThresholds& thresholds, const Run& run);

}  // namespace medial
