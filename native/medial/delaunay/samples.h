// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares the samples of a surface for a Delaunay triangulation.
#pragma once

#include "base/rows.h"

namespace medial {

// The points are the samples, and auxiliary points may follow them.
using Samples = DistinctRows;

// Throws InvalidInputError if all rows are within the smallest extent.
void require_extent(std::span<const Vec3> rows);

// Returns the distinct rows. Throws InvalidInputError as require_finite and require_extent do, and
// DegenerateInputError for fewer than 4 distinct rows.
Samples make_samples(std::span<const Vec3> rows, const Run& run);

// Returns the samples in ascending order of their rows.
std::vector<int32_t> samples_by_row(const Samples& samples);

// Appends the bounding sphere of sect. 4.2: 200 points, evenly spread over a sphere about the
// centre of the samples' box, with twice the radius of the samples.
void add_bounding_sphere(Samples& samples);

}  // namespace medial
