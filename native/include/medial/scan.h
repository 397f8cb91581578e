// SPDX-License-Identifier: GPL-3.0-or-later
// A scan is measured and prepared: points without faces, with noise, outliers and gaps.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <span>

namespace medial {

// Lengths are in the unit of the input.
struct ScanMeasure {
  double spacing = 0;  // the distance of neighbours, if the points were evenly spread
  double noise = 0;    // the standard deviation of a point from the surface; 0 where none is seen
  // The spread of the points over the noise is that of two layers or more, not that of errors: its
  // kurtosis, which is 3 for errors, 1.8 for an even spread, 1 for two layers.
  double kurtosis = 0;
  // How many pairs of close points have the same height over the surface, in units of what errors
  // have: 1 for errors, 1.5 to 2 where each view of a scan lies off as a whole. 0 where no noise is
  // seen, or where larger neighbourhoods hold two walls.
  double mates = 0;
  int64_t duplicates = 0;         // rows that repeat an earlier one
  std::vector<int32_t> outliers;  // ascending rows of points that stand alone
  double border = 0;  // the share of the points at which the surface ends: openings, gaps, rims
};

struct PreparedScan {
  std::vector<int32_t> rows;  // (k) ascending rows of the caller that were kept
  std::vector<Vec3> points;   // (k) their places on the surface
  std::vector<double> moved;  // (k) how far each of them was moved
};

// Measures noise, duplicates, outliers and borders of points. `threads` 0 means all cores; the
// result does not depend on it. Throws InvalidInputError, Cancelled.
ScanMeasure measure_scan(std::span<const Vec3> points, int threads = 0,
                         Progress* progress = nullptr);

// Lengths are in the unit of the input.
struct SurfaceNoise {
  double spacing = 0;  // the distance of neighbours, if the vertices were evenly spread
  double noise = 0;    // their standard deviation from a smooth surface; 0 where none is seen
  double radius = 0;   // of the neighbourhoods that show the noise, and not yet the shape
};

// Measures the noise of the vertices of faces. Only neighbours whose normals look the same way are
// compared, so the walls of thin parts are no noise. The normals are outward and of any length;
// those in one place are added, and vertices without any are left out. Throws InvalidInputError,
// Cancelled.
SurfaceNoise surface_noise(std::span<const Vec3> points, std::span<const Vec3> normals,
                           int threads = 0, Progress* progress = nullptr);

// Moves the vertices onto the quadrics of the neighbours that look the same way, within the radius
// of the measure, and returns the new places of all rows. Those without a normal or with few
// neighbours stay, and those that would move by many times the noise. Throws as above.
std::vector<Vec3> smooth_vertices(std::span<const Vec3> points, std::span<const Vec3> normals,
                                  const SurfaceNoise& measure, int threads = 0,
                                  Progress* progress = nullptr);

// Leaves the outliers out, moves the other points onto smooth surfaces through their neighbours,
// and keeps as many of them as the rest of the noise lets tell apart. Without `move` only the
// outliers and the duplicates are left out.
PreparedScan prepare_scan(std::span<const Vec3> points, const ScanMeasure& measure,
                          bool move = true, int threads = 0, Progress* progress = nullptr);

}  // namespace medial
