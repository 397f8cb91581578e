// SPDX-License-Identifier: GPL-3.0-or-later
// This decides which Delaunay edges MEDIAL selects (Dey & Zhao, sect. 3), and which of them belong
// to one side or to the limit set (Definition 4).
#pragma once

#include <medial/options.h>

#include "axis/significance.h"
#include "delaunay/edges.h"
#include "inside/sides.h"

namespace medial {

// A selection reads the Delaunay edges with their dual Voronoi facets, and their properties.
struct Facets {
  std::span<const Vec3> points;
  const Triangulation& triangulation;
  const Voronoi& voronoi;
  const Edges& edges;
  const Significance& significance;
  const CellSides& sides;  // empty if unknown
};

// These are the attributes of a selected facet.
struct FacetAttributes {
  double theta = 0, rho = 0;  // as combined by the rule
  Side side = Side::both;
};

// A selection decides for each edge whether its facet is selected. It keeps references to its
// input.
class Selection {
 public:
  virtual ~Selection() = default;
  // Sides other than `both` need known cell sides. Throws InvalidInputError for thresholds out of
  // range and for side `crossing`.
  Selection(const Extraction& wanted, const Facets& facets);

  // Walks the ring of cells only if the edge alone does not decide; `ring` then holds it
  // afterwards, and is empty otherwise.
  virtual bool wants(int32_t edge, std::vector<int32_t>& ring) const;
  const Facets& facets() const { return facets_; }
  const Extraction& wanted() const { return wanted_; }
  // Returns the attributes of the facet of a selected edge, given its ring.
  FacetAttributes attributes(int32_t edge, std::span<const int32_t> ring) const;

 private:
  bool satisfies_angle(int32_t edge) const;
  bool satisfies_ratio(int32_t edge) const;
  bool in_limit_set(int32_t edge, std::span<const int32_t> ring) const;

  Extraction wanted_;
  Facets facets_;
  double sine_ = 0;  // the largest sine that fails the Angle condition
};

// Throws InvalidInputError for thresholds out of range.
void require_in_range(const Thresholds& thresholds);

// Returns the positions in `edges` of those whose facets are selected, ascending.
std::vector<int32_t> selected(const Selection& selection, std::span<const int32_t> edges,
                              const Run& run);

}  // namespace medial
