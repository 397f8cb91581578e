// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/polygon_edges.h"

#include <medial/errors.h>

#include <algorithm>
#include <array>
#include <compare>
#include <string>

#include "base/atomic.h"
#include "base/csr.h"

namespace medial {
namespace {

// This is a side of a polygon, seen from its lower end.
struct PolygonSide {
  int32_t high;    // the other end
  int32_t corner;  // the corner at which it begins

  friend auto operator<=>(const PolygonSide&, const PolygonSide&) = default;
};

bool starts_edge(std::span<const PolygonSide> sorted, size_t i) {
  return i == 0 || sorted[i].high != sorted[i - 1].high;
}

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

void require_polygons(std::span<const int32_t> face_offsets, std::span<const int32_t> corners,
                      int32_t vertices) {
  const bool whole = !face_offsets.empty() && face_offsets.front() == 0 &&
                     face_offsets.back() == static_cast<int64_t>(corners.size()) &&
                     std::is_sorted(face_offsets.begin(), face_offsets.end());
  if (!whole) {
    throw InvalidInputError("Expected face_offsets that ascend from 0 to the number of corners, " +
                            std::to_string(corners.size()) + ", found others; rebuild the faces.");
  }
  const auto outside = [&](int32_t v) { return v < 0 || v >= vertices; };
  const auto bad = std::find_if(corners.begin(), corners.end(), outside);
  if (bad != corners.end()) {
    throw InvalidInputError("Expected corners in [0, " + std::to_string(vertices) + "), found " +
                            std::to_string(*bad) + "; rebuild the faces.");
  }
}

PolygonEdges polygon_edges(std::span<const int32_t> face_offsets, std::span<const int32_t> corners,
                           int32_t vertices, const Run& run) {
  require_polygons(face_offsets, corners, vertices);
  // Each vertex has a bucket of the corners whose edges have it as their lower end, stored with the
  // other ends. (bucket_sort knows only ids; looking up the ends took 1.7 times as long.) After the
  // counting next[v] is where bucket v begins, after the filling where it ends.
  std::vector<int64_t> next(static_cast<size_t>(vertices) + 1, 0);
  std::vector<PolygonSide> sides(corners.size());
  const auto for_sides = [&](const auto& body) {
    parallel_for(static_cast<int64_t>(face_offsets.size()) - 1, run, [&](int64_t face) {
      const int32_t begin = face_offsets[face], end = face_offsets[face + 1];
      for (int32_t corner = begin; corner < end; ++corner) {
        const int32_t other = corners[corner + 1 < end ? corner + 1 : begin];
        const auto [low, high] = std::minmax(corners[corner], other);
        body(corner, next[low], high);
      }
    });
  };
  for_sides([](int32_t, int64_t& count, int32_t) { shared_add<int64_t>(count, 1); });
  counts_to_offsets(next);
  for_sides([&](int32_t corner, int64_t& place, int32_t high) {
    sides[shared_add<int64_t>(place, 1)] = {high, corner};
  });
  const auto bucket = [&](int64_t v) {
    const auto begin = static_cast<size_t>(v == 0 ? 0 : next[v - 1]);
    return std::span(sides).subspan(begin, static_cast<size_t>(next[v]) - begin);
  };
  std::vector<int64_t> first(static_cast<size_t>(vertices) + 1, 0);
  parallel_for(vertices, run, [&](int64_t v) {
    const auto sorted = bucket(v);
    std::sort(sorted.begin(), sorted.end());
    for (size_t i = 0; i < sorted.size(); ++i) first[v] += starts_edge(sorted, i);
  });
  counts_to_offsets(first);
  PolygonEdges edges;
  edges.ends.resize(static_cast<size_t>(first.back()));
  edges.of_corner.resize(corners.size());
  parallel_for(vertices, run, [&](int64_t v) {
    auto id = static_cast<int32_t>(first[v]) - 1;
    const auto sorted = bucket(v);
    for (size_t i = 0; i < sorted.size(); ++i) {
      if (starts_edge(sorted, i)) edges.ends[++id] = {static_cast<int32_t>(v), sorted[i].high};
      edges.of_corner[sorted[i].corner] = id;
    }
  });
  return edges;
}

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
