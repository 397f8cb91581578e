// SPDX-License-Identifier: GPL-3.0-or-later
// The samples that lie opposite each other on close walls.
#pragma once

#include "base/csr.h"
#include "walls/samples_on_faces.h"

namespace medial {

class WallPartners {
 public:
  // `partner` is the row of a partner, or -1, per row of the samples; of two partners one names the
  // other. The samples must outlive this object.
  WallPartners(std::span<const int32_t> partner, const Samples& samples, const Run& run);

  // Returns whether two samples are partners, or each is next to the partner of the other one: then
  // they lie on opposite sides of one wall.
  bool are_across(const Edge& samples) const;

 private:
  bool are_across(int32_t p, int32_t across_p, int32_t q, int32_t across_q) const;

  const Samples& samples_;
  Csr<int32_t> partners_;  // per sample
};

// Marks the Delaunay edges across walls between partners. Their facets are selected: the tangent
// planes are known, even where umbrellas reach from one wall to the other.
void mark_partners(const WallPartners& partners, const Edges& edges, std::vector<EdgeMark>& marks,
                   const Run& run);

}  // namespace medial
