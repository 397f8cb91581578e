// SPDX-License-Identifier: GPL-3.0-or-later
// Which Delaunay edges MEDIAL selects (Dey & Zhao, sect. 3), and of them those of one side and of
// the limit set (Definition 4).
#pragma once

#include <medial/options.h>

#include "axis/significance.h"
#include "delaunay/edges.h"
#include "inside/sides.h"

namespace medial {

// The input of a selection: the Delaunay edges with their dual Voronoi facets, and the properties
// of these.
struct Facets {
  std::span<const Vec3> points;
  const Triangulation& triangulation;
  const Voronoi& voronoi;
  const Edges& edges;
  const Significance& significance;
  const CellSides& sides;  // empty: not known
};

// The attributes of a selected facet.
struct FacetAttributes {
  double theta = 0, rho = 0;  // as the rule takes them
  Side side = Side::both;
};

// Decides for each edge whether its facet is selected. Keeps references to what it reads.
class Selection {
 public:
  virtual ~Selection() = default;
  // A side other than `both` needs sides that are known. Throws InvalidInputError for thresholds
  // out of range and for side `crossing`.
  Selection(const Extraction& wanted, const Facets& facets);

  // Walks the ring of cells only where the edge alone does not tell; then `ring` holds it
  // afterwards, else nothing.
  virtual bool wants(int32_t edge, std::vector<int32_t>& ring) const;
  const Facets& facets() const { return facets_; }
  const Extraction& wanted() const { return wanted_; }
  // The attributes of the facet of a selected edge, whose ring is given.
  FacetAttributes attributes(int32_t edge, std::span<const int32_t> ring) const;

 private:
  bool satisfies_angle(int32_t edge) const;
  bool satisfies_ratio(int32_t edge) const;
  bool in_limit_set(int32_t edge, std::span<const int32_t> ring) const;

  Extraction wanted_;
  Facets facets_;
  double sine_ = 0;  // the largest that does not satisfy the Angle condition
};

// Positions in `edges` of those whose facets are selected, ascending.
std::vector<int32_t> selected(const Selection& selection, std::span<const int32_t> edges,
                              const Run& run);

}  // namespace medial
