// SPDX-License-Identifier: GPL-3.0-or-later
// The axes of other methods on the Delaunay triangulation of an analysis.
#pragma once

#include <medial/analysis.h>

#include "rivals/remark.h"
#include "rivals/size_selection.h"

namespace medial {

// The facets that MEDIAL selects when it measures edges as the Remark in sect. 3.2 does. Throws as
// MedialAnalysis::extract does.
MedialMesh axis_by_remark(const MedialAnalysis& analysis, Against against,
                          const Extraction& extraction = {}, Progress* progress = nullptr);

// The facets that a condition on sizes selects; by `lambda` the edges without a facet, too. Throws
// as MedialAnalysis::extract does, also for a negative length.
MedialMesh axis_by_size(const MedialAnalysis& analysis, const SizeExtraction& extraction,
                        Progress* progress = nullptr);
// Ids of the selected edges, as rows of MedialAnalysis::edge_rows, ascending.
std::vector<int32_t> select_by_size(const MedialAnalysis& analysis,
                                    const SizeExtraction& extraction);

// The poles as balls: a mesh of vertices alone. Throws as MedialAnalysis::extract does.
MedialMesh pole_axis(const MedialAnalysis& analysis, Side side = Side::both,
                     Progress* progress = nullptr);

}  // namespace medial
