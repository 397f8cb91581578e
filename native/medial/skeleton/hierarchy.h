// The hierarchy of the inner medial axis: one ordered collapse of the inner Voronoi complex, from
// which every level of simplification, the curve skeleton included, is read. Each has the topology
// of the solid.
#pragma once

#include "axis/selection.h"
#include "base/stopwatch.h"
#include "skeleton/level.h"
#include "skeleton/sheets.h"

namespace medial {

class Hierarchy {
 public:
  // `facets` know their sides. Thresholds out of range: InvalidInputError.
  Hierarchy(const Samples& samples, const Facets& facets, const Thresholds& thresholds,
            const Run& run);

  const Betti& betti() const { return betti_; }  // of the complex
  Level extract(const LevelThresholds& thresholds, Progress* progress = nullptr) const;

  const InnerComplex& complex() const { return parts_.complex; }
  const Hierarchical& parts() const { return parts_; }
  const Timings& timings() const { return timings_; }

 private:
  void find_values(const InnerComplex& complex, const Collapse& collapse, const Sheets& sheets,
                   const Burning& burning, const Wires& wires, std::span<const double> spacing,
                   const Run& run);

  Hierarchical parts_;
  Betti betti_ = {};
  int threads_;
  Timings timings_;
};

}  // namespace medial
