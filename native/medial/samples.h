// The input rows made fit for a Delaunay triangulation: finite, distinct, and in an order with
// spatial coherence.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "parallel.h"
#include "vec3.h"

namespace medial {

struct Samples {
  std::vector<Vec3>
      points;  // (n) distinct samples along a Hilbert curve, then any auxiliary points
  std::vector<int32_t> row;  // (n) input row of each sample: the first with its coordinates
  std::vector<int32_t> sample_of_row;  // (rows) sample of each input row

  int32_t count() const { return static_cast<int32_t>(row.size()); }
};

// Throws InvalidInputError naming the first row with a coordinate that is not finite, or too large
// to be squared often.
void require_finite(std::span<const Vec3> rows, const char* what);

// The rows along a Hilbert curve; the order depends on the coordinates alone but for equal rows.
Array<int32_t> hilbert_order(std::span<const Vec3> rows, const Run& run);

// The distinct rows; their order depends on the coordinates alone, so that permuted rows give the
// same samples. Throws InvalidInputError as require_finite does.
Samples distinct_rows(std::span<const Vec3> rows, const char* what, const Run& run);

// The same for a triangulation: throws also InvalidInputError when the rows lie too close together,
// DegenerateInputError for fewer than 4 distinct ones.
Samples make_samples(std::span<const Vec3> rows, const Run& run);

// The samples in ascending order of their rows.
std::vector<int32_t> samples_by_row(const Samples& samples);

// The bounding sphere of sect. 4.2: appends 200 points, evenly spread over a sphere of twice the
// radius of the samples about the centre of their box.
void add_bounding_sphere(Samples& samples);

}  // namespace medial
