// SPDX-License-Identifier: GPL-3.0-or-later
// The samples of a surface made fit for a Delaunay triangulation.
#pragma once

#include "base/rows.h"

namespace medial {

// The points are the samples, after which any auxiliary points may follow.
using Samples = DistinctRows;

// Throws InvalidInputError where rows lie closer together than the smallest extent.
void require_extent(std::span<const Vec3> rows);

// The distinct rows. Throws InvalidInputError as require_finite does and when the rows lie too
// close together, DegenerateInputError for fewer than 4 distinct ones.
Samples make_samples(std::span<const Vec3> rows, const Run& run);

// The samples in ascending order of their rows.
std::vector<int32_t> samples_by_row(const Samples& samples);

// The bounding sphere of sect. 4.2: appends 200 points, evenly spread over a sphere of twice the
// radius of the samples about the centre of their box.
void add_bounding_sphere(Samples& samples);

}  // namespace medial
