// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/polygon_areas.h"

#include <array>

#include "base/polygon_edges.h"

namespace medial {
namespace {

constexpr int32_t kLanes = 8, kHalved = 128;

// Sums term(first), term(first + 1), ... in the order of NumPy's sums, whose bits results had
// before.
template <typename Term>
Vec3 pairwise_sum(const Term& term, int32_t first, int32_t count) {
  if (count > kHalved) {
    const int32_t half = count / 2 / kLanes * kLanes;
    return pairwise_sum(term, first, half) + pairwise_sum(term, first + half, count - half);
  }
  const int32_t in_lanes = count / kLanes * kLanes;
  std::array<Vec3, kLanes> lane{};
  for (int32_t i = 0; i < in_lanes; ++i) lane[i % kLanes] = lane[i % kLanes] + term(first + i);
  Vec3 sum =
      ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
  for (int32_t i = in_lanes; i < count; ++i) sum = sum + term(first + i);
  return sum;
}

}  // namespace

std::vector<Vec3> doubled_areas(std::span<const Vec3> points, std::span<const int32_t> face_offsets,
                                std::span<const int32_t> corners, const Run& run) {
  require_polygons(face_offsets, corners, static_cast<int32_t>(points.size()));
  std::vector<Vec3> doubled(face_offsets.size() - 1);
  parallel_for(static_cast<int64_t>(doubled.size()), run, [&](int64_t face) {
    const int32_t begin = face_offsets[face], count = face_offsets[face + 1] - begin;
    const auto away = [&](int32_t i) {
      return points[corners[begin + i]] - points[corners[begin]];
    };
    const auto triangle = [&](int32_t i) { return cross(away(i), away((i + 1) % count)); };
    if (count > 0) doubled[face] = pairwise_sum(triangle, 1, count - 1);
  });
  return doubled;
}

}  // namespace medial
