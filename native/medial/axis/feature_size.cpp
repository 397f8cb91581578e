// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/feature_size.h"

#include <array>
#include <bit>

#include "base/point_tree.h"
#include "base/rows.h"

namespace medial {
namespace {

// The width of this grid cell grows with the radius of the balls at the vertices in it.
using GridCell = std::array<double, 4>;

// Vertices in the same cell are at most kThinning times the smaller of their balls apart, and no
// sample lies in these balls. Levels count from `unit`, that of the extent, so that the same shape
// in another unit has the same cells.
GridCell grid_cell(const Vec3& centre, double radius, int unit) {
  const int level = std::ilogb(radius);
  const double scale = std::ldexp(std::sqrt(3.0) / kThinning, -level);
  return {static_cast<double>(level - unit), std::floor(scale * centre.x),
          std::floor(scale * centre.y), std::floor(scale * centre.z)};
}

// This keeps the last cell that fell into each of its slots.
class RecentCells {
 public:
  // Returns whether the cell differs from the remembered one.
  bool insert(const GridCell& cell) {
    uint64_t hash = 0;
    for (const double x : cell) hash = (hash ^ std::bit_cast<uint64_t>(x)) * 0x9E3779B97F4A7C15u;
    GridCell& slot = slots_[hash >> 52];
    if (slot == cell) return false;
    slot = cell;
    return true;
  }

 private:
  std::vector<GridCell> slots_{1 << 12, GridCell{HUGE_VAL}};
};

// These are Voronoi vertices. The balls of the far ones are larger than the extent of the samples,
// so no sample is nearer to them than that. Flat faces may have many of them, so far away that they
// would inflate the boxes of a tree shared with the others.
struct Sites {
  std::vector<Vec3> near, far;
};

// Collects the Voronoi vertices of the marked cells, thinned to hardly more than one per cell of
// the grid. Vertices in one grid cell are close together on the surface, so they are mostly in one
// chunk, which remembers them.
Sites sites(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
            std::span<const uint8_t> marked, const Run& run) {
  constexpr int64_t kChunk = 1 << 15;
  const double extent = length(box_of(points).extent());
  const int unit = std::ilogb(extent);
  std::vector<Sites> parts(static_cast<size_t>(t.finite_cells / kChunk + 1));
  const auto collect = [&](int64_t begin, int64_t end, int) {
    RecentCells seen;
    for (int64_t c = begin; c < end; ++c) {
      if (!marked[c]) continue;
      const Vec3& centre = voronoi.centre[c];
      const double radius = distance(centre, points[t.cells[c][0]]);
      if (radius < HUGE_VAL && seen.insert(grid_cell(centre, radius, unit))) {
        Sites& part = parts[begin / kChunk];
        (radius <= extent ? part.near : part.far).push_back(centre);
      }
    }
  };
  parallel_chunks(t.finite_cells, run, collect, kChunk);
  Sites all;
  for (const auto& [near, far] : parts) {
    all.near.insert(all.near.end(), near.begin(), near.end());
    all.far.insert(all.far.end(), far.begin(), far.end());
  }
  return all;
}

}  // namespace

std::vector<double> feature_size(std::span<const Vec3> points, std::span<const int32_t> at,
                                 const Triangulation& t, const Voronoi& voronoi, const Edges& edges,
                                 std::span<const int32_t> edge_ids, const Run& run) {
  const auto marked = cells_round(edge_ids, t, edges, run);
  const Sites all = sites(points, t, voronoi, marked, run);
  const PointTree near = PointTree::sorted(all.near, run), far = PointTree::sorted(all.far, run);
  const double extent = length(box_of(points).extent());
  // The loop follows the spatial order of the points, so neighbours visit the same part of the
  // tree.
  std::vector<uint8_t> wanted(points.size(), 0);
  for (const int32_t p : at) wanted[p] = 1;
  std::vector<double> size(points.size());
  parallel_for(static_cast<int64_t>(points.size()), run, [&](int64_t p) {
    if (!wanted[p]) return;
    size[p] = near.nearest(points[p]).distance;
    if (size[p] > extent) size[p] = std::min(size[p], far.nearest(points[p]).distance);
  });
  return rows_of(size, at);
}

}  // namespace medial
