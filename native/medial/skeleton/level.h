// SPDX-License-Identifier: GPL-3.0-or-later
// The levels of a hierarchy: the cells whose values are above some thresholds.
#pragma once

#include <medial/hierarchy.h>

#include "base/frame.h"
#include "base/point_tree.h"
#include "base/stopwatch.h"
#include "skeleton/values.h"

namespace medial {

// The results from which the levels are made.
struct Hierarchy::Parts {
  Frame frame;  // in which all places and lengths below are, those of levels, too
  InnerComplex complex;
  Array<int32_t> partner;  // as in Collapse
  Values values;
  Array<float> limb;        // per vertex
  Array<double> sine, rho;  // per facet, as in Significance
  PointTree samples;
  std::vector<int32_t> row;  // of the samples
  Array<int32_t> outside;    // as from outside_components
  Betti betti = {};          // of the complex
  int threads = 1;
  Timings timings;

  // The limb of the vertex or facet that the edge went with.
  float limb_of_edge(int32_t edge) const {
    if (partner[edge] == kAlone) return HUGE_VALF;
    return partner[edge] >= 0 ? 0 : limb[with_vertex(partner[edge])];
  }
};

// Whether thresholds leave a cell with this value.
bool exceeds(const Thickness& value, const LevelOptions& t);

// Throws InvalidInputError for thresholds below 0.
Level level(const Hierarchy::Parts& hierarchy, const LevelOptions& options, const Run& run);

}  // namespace medial
