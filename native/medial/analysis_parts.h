// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of an analysis are the results of its stages, which extractions read.
#pragma once

#include <medial/analysis.h>

#include "axis/selection.h"
#include "base/frame.h"
#include "delaunay/samples.h"
#include "inside/pockets.h"

namespace medial {

struct MedialAnalysis::Parts {
  Parts() = default;
  // The arrays are in the arena, and a move would free the arena before them.
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  int threads = 1;
  std::unique_ptr<Arena> arena;  // is destroyed after all that is in it
  Frame frame;                   // frame of all places and lengths below
  Samples samples;
  Triangulation triangulation;
  Voronoi voronoi;
  Edges edges;
  Significance significance;
  CellSides sides;
  SmallParts small;  // parts of the inner cells that the hierarchy may leave out
  SidesFrom sides_from = SidesFrom::none;
  std::optional<double> pole_disagreement;
  std::shared_ptr<const WatertightSurface> tight_cocone;
  int64_t duplicates = 0, boundary_edges = 0;
  bool closed = false;
  Timings timings;

  // Returns the run of a stage that reads these parts.
  Run run(Progress* progress = nullptr) const { return {threads, progress, arena.get()}; }
};

// Runs the stages.
std::unique_ptr<const MedialAnalysis::Parts> analysed(const AnalysisInput& input,
                                                      const AnalysisOptions& options,
                                                      Progress* progress);

// Throws InvalidInputError unless there is one finite normal per row, and not all are zero.
void require_normals(std::span<const Vec3> normals, size_t rows);
// Throws InvalidInputError if inside and outside are unknown, DegenerateInputError if the samples
// enclose nothing.
void require_solid(const MedialAnalysis::Parts& made);

// Returns the facets that a selection reads.
Facets facets_of(const MedialAnalysis::Parts& made);
// Returns all edges in lexicographic order of their input rows.
std::vector<int32_t> edges_by_row(const MedialAnalysis::Parts& made);
// Converts a mesh from the frame of the analysis to that of the input.
void bring_outward(MedialMesh& mesh, const Frame& frame);

}  // namespace medial
