// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/triangulation.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/cgal.h"
#include "base/sort.h"
// clang-format off: CGAL's headers come after what sets CGAL up.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
// clang-format on
#include "base/filtered_kernel.h"
#include "base/insertion_order.h"

namespace medial {
namespace {

using Kernel = FilteredKernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<int32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<int32_t, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using CellHandle = Delaunay::Cell_handle;
using CellRange = Delaunay::Triangulation_data_structure::Cell_range;
static_assert(std::is_same_v<CellRange::allocator_type, RunAllocator<CellRange::value_type>>,
              "CGAL no longer takes its memory by CGAL_ALLOCATOR");

void insert_all(Delaunay& delaunay, std::span<const Vec3> points, Progress* progress) {
  constexpr size_t kStep = 512;
  CellHandle hint;
  const auto order = insertion_order(static_cast<int32_t>(points.size()));
  for (size_t i = 0; i < order.size(); ++i) {
    if (i % kStep == 0)
      advance(progress, static_cast<double>(i) / static_cast<double>(order.size()));
    const Vec3& p = points[order[i]];
    const auto vertex = delaunay.insert({p.x, p.y, p.z}, hint);
    vertex->info() = order[i];
    hint = vertex->cell();
  }
}

// Holds a cell in canonical order, and the permutation: slots[j] is the new place of corner j.
struct CanonicalCell {
  Cell ids;  // sorted except for the last two, which keep the orientation positive
  std::array<int8_t, 4> slots;

  // Returns the lowest finite id; infinite cells come after the finite ones.
  int32_t bucket(int32_t points) const { return ids[0] == kInfinite ? points + ids[1] : ids[0]; }
  // Returns the key that sorts the cells of one bucket, which share their lowest id, by the other
  // ids.
  std::pair<uint64_t, int32_t> key() const {
    const auto [low, high] = std::minmax(ids[2], ids[3]);
    return {static_cast<uint64_t>(ids[1]) << 32 | static_cast<uint32_t>(low), high};
  }
};

// Moves each id to the slot of its rank, which is counted by comparisons. A sort would branch, and
// the cells come in any order, so half of its branches would be mispredicted.
CanonicalCell canonical(const Cell& x) {
  const int a = x[0] > x[1], b = x[0] > x[2], c = x[0] > x[3];
  const int d = x[1] > x[2], e = x[1] > x[3], f = x[2] > x[3];
  const int odd = a ^ b ^ c ^ d ^ e ^ f;
  const std::array rank{a + b + c, 1 - a + d + e, 2 - b - d + f, 3 - c - e - f};
  CanonicalCell cell{};
  for (int j = 0; j < 4; ++j) {
    const int slot = rank[j] ^ (odd & (rank[j] >> 1));
    cell.ids[slot] = x[j];
    cell.slots[j] = static_cast<int8_t>(slot);
  }
  return cell;
}

Array<CellHandle> handles_of(const Delaunay& delaunay, const Run& run) {
  auto handles = array<CellHandle>(0, run);
  handles.reserve(delaunay.tds().number_of_cells());
  for (auto cell = delaunay.all_cells_begin(); cell != delaunay.all_cells_end(); ++cell) {
    handles.push_back(cell);
  }
  return handles;
}

Triangulation as_arrays(const Delaunay& delaunay, int32_t points, const Run& run) {
  begin_stage(run.progress, "Delaunay cells", 0.5, 0.52);
  const auto handles = handles_of(delaunay, run);
  const auto count = static_cast<int64_t>(handles.size());
  auto found = array<CanonicalCell>(handles.size(), run);
  parallel_for(count, run, [&](int64_t i) {
    Cell ids;
    for (int j = 0; j < 4; ++j) ids[j] = handles[i]->vertex(j)->info();
    found[i] = canonical(ids);
  });
  begin_stage(run.progress, "Delaunay cells", 0.52, 0.54);
  auto place = array<int32_t>(handles.size(), run);
  bucket_sort(
      count, 2 * static_cast<size_t>(points), {run.threads, nullptr, run.arena},
      [&](int64_t i) { return found[i].bucket(points); }, [&](int64_t i) { return found[i].key(); },
      [&](int32_t position, int32_t i) { place[i] = position; });
  parallel_for(count, run, [&](int64_t i) { handles[i]->info() = place[i]; });
  begin_stage(run.progress, "Delaunay cells", 0.54, 0.58);
  Triangulation result{array<Cell>(handles.size(), run), array<Cell>(handles.size(), run)};
  parallel_for(count, run, [&](int64_t i) {
    const auto& [ids, slots] = found[i];
    result.cells[place[i]] = ids;
    Cell& neighbors = result.neighbors[place[i]];
    for (int j = 0; j < 4; ++j) neighbors[slots[j]] = handles[i]->neighbor(j)->info();
  });
  const auto infinite = std::partition_point(result.cells.begin(), result.cells.end(),
                                             [](const Cell& ids) { return ids[0] != kInfinite; });
  result.finite_cells = static_cast<int32_t>(infinite - result.cells.begin());
  return result;
}

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

// Returns 0 for one place, 1 for one line, 2 for one plane, and 3 for a volume.
int affine_dimension(std::span<const Vec3> points) {
  const auto first = points.begin(), end = points.end();
  const auto second = std::find_if(first, end, [&](const Vec3& p) { return p != *first; });
  if (second == end) return 0;
  const auto third = std::find_if(second, end, [&](const Vec3& p) {
    return !CGAL::collinear(point(*first), point(*second), point(p));
  });
  if (third == end) return 1;
  const auto fourth = std::find_if(third, end, [&](const Vec3& p) {
    return !CGAL::coplanar(point(*first), point(*second), point(*third), point(p));
  });
  return fourth == end ? 2 : 3;
}

}  // namespace

void require_volume(std::span<const Vec3> points) {
  const char* const found[] = {"in one place", "on one line", "in one plane"};
  const int dimension = points.empty() ? 0 : affine_dimension(points);
  if (dimension == 3) return;
  throw DegenerateInputError("Expected points that span a volume, found all " +
                             std::to_string(points.size()) + " " + found[dimension] +
                             "; add points off it.");
}

Triangulation triangulate(std::span<const Vec3> points, const Run& run, Stopwatch* watch) {
  begin_stage(run.progress, "Delaunay triangulation", 0.02, 0.5);
  try {
    const InArena in_arena(run.arena);
    Delaunay delaunay;
    insert_all(delaunay, points, run.progress);
    delaunay.infinite_vertex()->info() = kInfinite;
    if (watch) watch->lap("triangulation");
    return as_arrays(delaunay, static_cast<int32_t>(points.size()), run);
  } catch (const CGAL::Failure_exception& failure) {
    throw DegenerateInputError(std::string("Expected points that CGAL can triangulate, found: ") +
                               failure.what() + "; move or thin the points.");
  }
}

}  // namespace medial
