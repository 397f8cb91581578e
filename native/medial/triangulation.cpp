#include "triangulation.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

namespace medial {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<int32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<int32_t, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using CellHandle = Delaunay::Cell_handle;

constexpr size_t kBatch = 1 << 17;  // cells between two looks at the cancel flag

struct OrderedCell {
  Cell ids;
  CellHandle handle;
};

uint64_t scrambled(uint64_t x) {  // SplitMix64 (Steele, Lea, Flood 2014)
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Biased randomized insertion order (Amenta, Choi, Rote 2003): each round is an eighth of the next,
// and keeps the spatial order of the ids.
std::vector<int32_t> insertion_order(int32_t count) {
  std::vector<std::vector<int32_t>> rounds(1);
  for (int32_t id = 0; id < count; ++id) {
    size_t level = 0;
    for (uint64_t bits = scrambled(static_cast<uint64_t>(id)); bits % 8 == 0 && level < 20;
         bits /= 8) {
      ++level;
    }
    if (level >= rounds.size()) rounds.resize(level + 1);
    rounds[level].push_back(id);
  }
  std::vector<int32_t> order;
  order.reserve(static_cast<size_t>(count));
  for (auto round = rounds.rbegin(); round != rounds.rend(); ++round) {
    order.insert(order.end(), round->begin(), round->end());
  }
  return order;
}

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

// Sorted but for the last two, which keep the orientation positive.
Cell canonical(Cell ids) {
  bool odd = false;
  for (int i = 1; i < 4; ++i) {
    for (int j = i; j > 0 && ids[j - 1] > ids[j]; --j) {
      std::swap(ids[j - 1], ids[j]);
      odd = !odd;
    }
  }
  if (odd) std::swap(ids[2], ids[3]);
  return ids;
}

bool lexicographically_before(const OrderedCell& a, const OrderedCell& b) {
  const auto sorted = [](Cell ids) {
    if (ids[2] > ids[3]) std::swap(ids[2], ids[3]);
    return ids;
  };
  return sorted(a.ids) < sorted(b.ids);
}

// A counting sort by lowest finite id, infinite cells after the finite ones, then small sorts
// within the buckets.
std::vector<OrderedCell> ordered_cells(const Delaunay& delaunay, int32_t points, const Run& run) {
  const auto bucket = [&](const Cell& ids) {
    return ids[0] == kInfinite ? points + ids[1] : ids[0];
  };
  const size_t count = delaunay.tds().number_of_cells();
  std::vector<OrderedCell> found;
  found.reserve(count);
  std::vector<int64_t> start(2 * static_cast<size_t>(points) + 1, 0);
  for (auto cell = delaunay.all_cells_begin(); cell != delaunay.all_cells_end(); ++cell) {
    Cell ids;
    for (int i = 0; i < 4; ++i) {
      ids[i] = delaunay.is_infinite(cell->vertex(i)) ? kInfinite : cell->vertex(i)->info();
    }
    ids = canonical(ids);
    ++start[bucket(ids) + 1];
    if (found.size() % kBatch == 0)
      advance(run.progress, 0.3 * static_cast<double>(found.size()) / static_cast<double>(count));
    found.push_back({ids, cell});
  }
  for (size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<OrderedCell> ordered(count);
  auto next = start;
  for (size_t i = 0; i < count; ++i) {
    if (i % kBatch == 0)
      advance(run.progress, 0.3 + 0.2 * static_cast<double>(i) / static_cast<double>(count));
    ordered[next[bucket(found[i].ids)]++] = found[i];
  }
  begin_stage(run.progress, "Delaunay cells", 0.54, 0.56);
  parallel_for(static_cast<int64_t>(start.size()) - 1, run, [&](int64_t b) {
    std::sort(ordered.begin() + start[b], ordered.begin() + start[b + 1], lexicographically_before);
  });
  return ordered;
}

Triangulation as_arrays(const Delaunay& delaunay, int32_t points, const Run& run) {
  begin_stage(run.progress, "Delaunay cells", 0.5, 0.58);
  const auto ordered = ordered_cells(delaunay, points, run);
  Triangulation result;
  result.cells.resize(ordered.size());
  result.neighbors.resize(ordered.size());
  parallel_for(static_cast<int64_t>(ordered.size()), run, [&](int64_t c) {
    result.cells[c] = ordered[c].ids;
    ordered[c].handle->info() = static_cast<int32_t>(c);
  });
  begin_stage(run.progress, "Delaunay cells", 0.56, 0.58);
  parallel_for(static_cast<int64_t>(ordered.size()), run, [&](int64_t c) {
    const CellHandle cell = ordered[c].handle;
    for (int j = 0; j < 4; ++j) {
      const auto vertex = cell->vertex(j);
      const int32_t id = delaunay.is_infinite(vertex) ? kInfinite : vertex->info();
      const auto slot = std::find(result.cells[c].begin(), result.cells[c].end(), id);
      result.neighbors[c][static_cast<size_t>(slot - result.cells[c].begin())] =
          cell->neighbor(j)->info();
    }
  });
  const auto infinite = std::partition_point(result.cells.begin(), result.cells.end(),
                                             [](const Cell& ids) { return ids[0] != kInfinite; });
  result.finite_cells = static_cast<int32_t>(infinite - result.cells.begin());
  return result;
}

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

// 0: one place, 1: one line, 2: one plane, 3: a volume.
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

Triangulation triangulate(std::span<const Vec3> points, const Run& run) {
  begin_stage(run.progress, "Delaunay triangulation", 0.02, 0.5);
  try {
    Delaunay delaunay;
    insert_all(delaunay, points, run.progress);
    return as_arrays(delaunay, static_cast<int32_t>(points.size()), run);
  } catch (const CGAL::Failure_exception& failure) {
    throw DegenerateInputError(std::string("Expected points that CGAL can triangulate, found: ") +
                               failure.what() + "; move or thin the points.");
  }
}

}  // namespace medial
