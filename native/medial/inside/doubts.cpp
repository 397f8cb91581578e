// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/doubts.h"

#include <optional>

namespace medial {
namespace {

constexpr double kOtherWall = -0.2;  // the cosine between the normals of two walls; chosen: unseen
// Places closer than this share of the way to the samples are one: there a Voronoi edge meets an
// edge of the surface, or touches it.
constexpr double kOnePlace = 1e-3;  // chosen: unseen

using Hit = RayCrossings::Hit;

// Holds the part of a Voronoi edge that is near its samples.
struct NearPart {
  Vec3 from, direction;
  double length;
  std::array<int32_t, 3> samples;

  Vec3 at(const Hit& hit) const { return from + hit.at * direction; }
};

// Returns how far the Voronoi vertex of a cell is along the line of an edge; it is infinitely far
// for an infinite cell.
double place_on_line(const Vec3& middle, const Vec3& direction, const Triangulation& triangulation,
                     const Voronoi& voronoi, int32_t cell) {
  if (!triangulation.is_infinite(cell)) return dot(voronoi.centre[cell] - middle, direction);
  return dot(voronoi.centre[cell], direction) > 0 ? HUGE_VAL : -HUGE_VAL;
}

std::optional<NearPart> near_part(const DoubtInput& input, int32_t cell, int corner) {
  const auto& [points, normals, reach, triangulation, voronoi] = input;
  const int32_t other = triangulation.neighbors[cell][corner];
  if (voronoi.vertex[cell] == voronoi.vertex[other]) return {};
  const Cell& ids = triangulation.cells[cell];
  const std::array<int32_t, 3> samples{ids[(corner + 1) % 4], ids[(corner + 2) % 4],
                                       ids[(corner + 3) % 4]};
  double farthest = HUGE_VAL;
  for (const int32_t p : samples) {
    if (p >= std::ssize(reach)) return {};  // auxiliary points follow the samples
    farthest = std::min(farthest, reach[p]);
  }
  const Vec3 &o = points[samples[0]], u = points[samples[1]] - o, v = points[samples[2]] - o;
  const Vec3 n = cross(u, v);
  const double doubled = squared_length(n);
  if (!(doubled > 0)) return {};
  const Vec3 to_middle =
      (0.5 / doubled) * (squared_length(u) * cross(v, n) + squared_length(v) * cross(n, u));
  const double squared = farthest * farthest - squared_length(to_middle);
  if (!(squared > 0)) return {};
  const Vec3 middle = o + to_middle, direction = normalized(n);
  const double one = place_on_line(middle, direction, triangulation, voronoi, cell);
  const double two = place_on_line(middle, direction, triangulation, voronoi, other);
  const double low = std::max(std::min(one, two), -std::sqrt(squared));
  const double high = std::min(std::max(one, two), std::sqrt(squared));
  if (!(high > low)) return {};
  return NearPart{middle + low * direction, direction, high - low, samples};
}

// Sorts the hits, and leaves one or none of those in one place.
void merge(std::vector<Hit>& hits, double one_place) {
  std::sort(hits.begin(), hits.end());
  size_t kept = 0;
  for (size_t begin = 0, end = 0; begin < hits.size(); begin = end) {
    int sum = 0;
    for (; end < hits.size() && hits[end].at - hits[begin].at <= one_place; ++end) {
      sum += hits[end].cosine > 0 ? 1 : -1;
    }
    if (sum != 0) hits[kept++] = hits[begin];
  }
  hits.resize(kept);
}

bool is_on_other_wall(const NearPart& edge, std::span<const Vec3> normals, const Hit& hit) {
  return std::any_of(edge.samples.begin(), edge.samples.end(),
                     [&](int32_t p) { return dot(normals[p], hit.normal) < kOtherWall; });
}

void doubts_at(const NearPart& edge, const DoubtInput& input, std::span<const Hit> hits,
               std::vector<Doubt>& out) {
  if (hits.size() == 1) {
    if (!is_on_other_wall(edge, input.normals, hits[0])) return;
    const Vec3 place = edge.at(hits[0]);
    out.push_back({place, distance(place, input.points[edge.samples[0]])});
    return;
  }
  for (size_t i = 0; i < hits.size(); ++i) {
    const size_t next = i + 1 < hits.size() ? i + 1 : i - 1;
    out.push_back({edge.at(hits[i]), std::abs(hits[next].at - hits[i].at)});
  }
}

}  // namespace

std::vector<Doubt> doubts(const DoubtInput& input, const RayCrossings& surface, const Run& run) {
  const Triangulation& triangulation = input.triangulation;
  return parallel_append<Doubt>(
      triangulation.finite_cells, run, [&](int64_t id, std::vector<Doubt>& out, int) {
        thread_local std::vector<Hit> hits;
        const auto cell = static_cast<int32_t>(id);
        for (int corner = 0; corner < 4; ++corner) {
          if (triangulation.neighbors[cell][corner] < cell) continue;
          const auto edge = near_part(input, cell, corner);
          if (!edge) continue;
          surface.hits(edge->from, edge->direction, edge->length, hits);
          merge(hits, kOnePlace * distance(edge->from, input.points[edge->samples[0]]));
          if (!hits.empty()) doubts_at(*edge, input, hits, out);
        }
      });
}

}  // namespace medial
