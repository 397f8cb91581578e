// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/poles.h"

#include "base/sort_unique.h"

namespace medial {
namespace {

// Returns the vector to the farthest Voronoi vertex, ties by lowest cell.
Vec3 to_farthest_vertex(const Vec3& p, std::span<const int32_t> finite_cells,
                        const Voronoi& voronoi) {
  Vec3 farthest;
  for (const int32_t cell : finite_cells) {
    const Vec3 v = voronoi.centre[cell] - p;
    if (squared_length(v) > squared_length(farthest)) farthest = v;
  }
  return farthest;
}

// Averages the infinite edges; each counts once, however many cocircular hull triangles share it.
Vec3 mean_direction(std::span<const int32_t> infinite_cells, const Voronoi& voronoi,
                    std::vector<int32_t>& rays) {
  rays.clear();
  for (const int32_t cell : infinite_cells) rays.push_back(voronoi.vertex[cell]);
  sort_unique(rays);
  Vec3 sum;
  for (const int32_t ray : rays) sum = sum + voronoi.centre[ray];
  return (1 / static_cast<double>(rays.size())) * sum;
}

// Returns the number of finite cells of a sample, which come first.
size_t finite_count(std::span<const int32_t> cells, const Triangulation& t) {
  return static_cast<size_t>(std::lower_bound(cells.begin(), cells.end(), t.finite_cells) -
                             cells.begin());
}

}  // namespace

Vec3 pole(const Vec3& p, std::span<const int32_t> cells, const Triangulation& t,
          const Voronoi& voronoi, std::vector<int32_t>& room) {
  const size_t finite = finite_count(cells, t);
  Vec3 found;
  if (finite < cells.size()) found = mean_direction(cells.subspan(finite), voronoi, room);
  // If the directions cancel out, the farthest vertex is used, as in a bounded cell.
  if (found == Vec3{}) found = to_farthest_vertex(p, cells.first(finite), voronoi);
  return found;
}

Poles poles(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
            const Csr<int32_t>& incident, const Run& run) {
  begin_stage(run.progress, "Poles", 0.88, 0.9);
  const auto samples = static_cast<size_t>(incident.size());
  Poles result{array<Vec3>(samples, run), array<uint8_t>(samples, run)};
  parallel_chunks(incident.size(), run, [&](int64_t begin, int64_t end, int) {
    std::vector<int32_t> room;
    for (int64_t p = begin; p < end; ++p) {
      result.vector[p] = pole(points[p], incident[p], t, voronoi, room);
      result.unbounded[p] = finite_count(incident[p], t) < incident[p].size();
    }
  });
  return result;
}

}  // namespace medial
