// SPDX-License-Identifier: GPL-3.0-or-later
// A level of a hierarchy consists of the cells whose values are above some thresholds.
#pragma once

#include <medial/hierarchy.h>

#include <mutex>

#include "base/frame.h"
#include "base/point_tree.h"
#include "base/stopwatch.h"
#include "collapse/betti.h"
#include "collapse/weight.h"
#include "exact/crisp.h"
#include "levels/spikes.h"

namespace medial {

// The remesher knows this of the vertices of an even mesh, in their order in the level.
struct EvenVertices {
  std::vector<double> target;   // as in EvenMesh
  std::vector<uint8_t> held;    // likewise
  std::vector<uint8_t> is_end;  // as SheetComplex::stays
};

// The hierarchy of an even mesh has this beyond others.
struct EvenBase {
  EvenVertices vertices;
  std::vector<Vec3> exact;           // (v) the place that the vertex stands for, as in Level
  std::vector<double> exact_radius;  // (v)
  Array<float> limb;                 // per edge: value that it had as a wire; 0 for other edges
};

// Holds the results from which the levels are made.
struct Hierarchy::Parts {
  Frame frame;  // coordinates of all places and lengths below, and of levels
  InnerComplex complex;
  Array<int32_t> partner;  // as in Collapse
  Values values;
  Array<float> thickness;  // per facet: its erosion thickness itself, as a share of the diagonal
  mutable SpikeValues spikes;  // computed when a level first asks for it
  mutable std::once_flag spikes_known;
  Array<float> limb;                               // per vertex
  Array<double> sine, rho;                         // per facet, as in Significance
  Array<Chosen> chosen;                            // per facet
  Thresholds thresholds;                           // those of `chosen`
  std::shared_ptr<const Faces> faces;              // null if there are none
  std::shared_ptr<const SamplesOnFaces> on_faces;  // likewise
  std::shared_ptr<const EvenBase> even;            // null unless the facets are an even mesh
  CrispPlaces crisp;         // empty without faces, or where they were not wanted
  Array<uint8_t> on_crease;  // per vertex: whether a rim ends there; empty without faces
  std::shared_ptr<const PointTree> samples;
  std::shared_ptr<const std::vector<int32_t>> row;     // of each sample in the input
  std::shared_ptr<const std::vector<double>> spacing;  // of each sample: the largest hole beside it
  Array<int32_t> outside;                              // result of outside_components
  Betti betti = {};                                    // of the complex
  int threads = 1;
  Timings timings;

  // Returns the limb value of the vertex that the edge was removed with, or 0 for a facet.
  float limb_of_edge(int32_t edge) const {
    if (partner[edge] == kAlone) return HUGE_VALF;
    return partner[edge] >= 0 ? 0 : limb[with_vertex(partner[edge])];
  }
};

// Returns whether a cell with this value is above the thresholds.
bool exceeds(const Thickness& value, const LevelOptions& t);

// Returns the values by which spikes are dropped.
const SpikeValues& spikes(const Hierarchy::Parts& h, const Run& run);

// Returns the cells of a level.
Alive alive_at(const Hierarchy::Parts& h, const LevelOptions& t, const Run& run);

// Extracts a level. Throws InvalidInputError for thresholds below 0.
Level level(const Hierarchy::Parts& hierarchy, const LevelOptions& options, const Run& run);

}  // namespace medial
