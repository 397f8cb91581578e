// SPDX-License-Identifier: GPL-3.0-or-later
// The facets of an axis, their measures, and which of them meet at each edge.
#pragma once

#include <medial/structure.h>

#include "base/csr.h"
#include "base/polygon_edges.h"
#include "base/vec3.h"

namespace medial {

struct Facets {
  StructureInput input;
  PolygonEdges edges;
  Csr<int32_t> at_edge;          // facets at each edge, ascending
  std::vector<uint8_t> forward;  // in the order of at_edge: whether the facet passes the edge from
                                 // its lower to its higher end
  std::vector<double> area;      // (f)
  std::vector<double> spacing;   // (f) mean of its generators
  std::vector<double> radius;    // (f) mean of its corners
  std::vector<Vec3> middle;      // (f) mean of its corners
  std::vector<Vec3> normal;      // (f) as long as the area

  int32_t count() const { return static_cast<int32_t>(area.size()); }
  int32_t edge_count() const { return static_cast<int32_t>(edges.ends.size()); }
  std::span<const int32_t> corners(int64_t facet) const {
    const auto begin = static_cast<size_t>(input.face_offsets[facet]);
    return input.face_vertices.subspan(begin,
                                       static_cast<size_t>(input.face_offsets[facet + 1]) - begin);
  }
  double length(int32_t edge) const {
    const auto& [a, b] = edges.ends[edge];
    return distance(input.vertices[a], input.vertices[b]);
  }
};

// Throws InvalidInputError for arrays that do not fit.
Facets facets_of(const StructureInput& input, const Run& run);

}  // namespace medial
