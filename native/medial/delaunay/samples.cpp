// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/samples.h"

#include <medial/errors.h>

#include <numbers>
#include <string>

#include "base/portable_math.h"

namespace medial {

void require_extent(std::span<const Vec3> rows) {
  const double extent = max_abs(box_of(rows).extent());
  if (rows.size() >= 4 && extent > 0 && extent < kSmallestExtent) {
    throw InvalidInputError(
        "Expected points that spread over more than 1e-50, found less; scale them up.");
  }
}

Samples make_samples(std::span<const Vec3> rows, const Run& run) {
  Samples samples = distinct_rows(rows, "point", run);
  require_extent(rows);
  if (samples.count() < 4) {
    throw DegenerateInputError("Expected at least 4 distinct points, found " +
                               std::to_string(samples.count()) + "; add points.");
  }
  return samples;
}

std::vector<int32_t> samples_by_row(const Samples& samples) {
  std::vector<int32_t> order;
  order.reserve(samples.row.size());
  for (int32_t row = 0; row < static_cast<int32_t>(samples.point_of_row.size()); ++row) {
    const int32_t id = samples.point_of_row[row];
    if (samples.row[id] == row) order.push_back(id);
  }
  return order;
}

void add_bounding_sphere(Samples& samples) {
  constexpr int kPoints = 200;
  const Vec3 centre = box_of(samples.points).centre();
  double radius = 0;
  for (const Vec3& p : samples.points) radius = std::max(radius, distance(p, centre));
  // These points form a Fibonacci lattice: equal steps in height, golden-angle steps around the
  // axis.
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1 - (2 * i + 1.0) / kPoints, r = std::sqrt(1 - z * z);
    const auto [sine, cosine] = portable::sine_cosine(golden_angle * i);
    const Vec3 direction{r * cosine, r * sine, z};
    samples.points.push_back(centre + 2 * radius * direction);
  }
}

}  // namespace medial
