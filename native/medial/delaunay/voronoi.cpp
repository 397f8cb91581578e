// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/voronoi.h"

#include <algorithm>

#include "base/union_find.h"
#include "delaunay/circumcentre.h"

namespace medial {
namespace {

using CellPair = std::pair<int32_t, int32_t>;

struct Centres {
  Array<Vec3> centre;
  Array<float> error;  // rounded up
};

float rounded_up(double x) { return std::nextafter(static_cast<float>(x), HUGE_VALF); }

Centres centres(std::span<const Vec3> points, const Triangulation& t, const Run& run) {
  Centres result{array<Vec3>(t.cells.size(), run), array<float>(t.cells.size(), run)};
  parallel_for(t.cell_count(), run, [&](int64_t c) {
    const auto& [i, j, k, l] = t.cells[c];
    if (i == kInfinite) {
      // The infinite vertex is outside and the orientation positive, so the outward normal turns
      // the other way.
      const UnitNormal n = unit_normal(points[j], points[l], points[k]);
      result.centre[c] = n.direction;
      result.error[c] = rounded_up(n.error);
    } else {
      const Circumcentre o = circumcentre(points[i], points[j], points[k], points[l]);
      result.centre[c] = o.centre;
      result.error[c] = rounded_up(o.error);
    }
  });
  return result;
}

void unite(UnionFind& vertices, std::span<const CellPair> pairs) {
  for (const auto& [a, b] : pairs) vertices.unite(a, b);
}

bool indistinguishable(const Centres& centres, int32_t a, int32_t b) {
  const double error = static_cast<double>(centres.error[a]) + centres.error[b];
  const Vec3 d = centres.centre[a] - centres.centre[b];
  return squared_length(d) <= error * error;
}

Array<CellPair> close_pairs(const Triangulation& t, const Centres& centres, const Run& run) {
  auto all = array<CellPair>(0, run);
  parallel_append_to(all, t.finite_cells, run, [&](int64_t c, auto& pairs, int) {
    for (const int32_t n : t.neighbors[c]) {
      const auto cell = static_cast<int32_t>(c);
      if (n > cell && !t.is_infinite(n) && indistinguishable(centres, cell, n)) {
        pairs.push_back({cell, n});
      }
    }
  });
  return all;
}

Circumcentre fine_centre(std::span<const Vec3> points, const Cell& cell) {
  const auto& [i, j, k, l] = cell;
  return circumcentre(points[i], points[j], points[k], points[l], kFinestError);
}

// Returns which of the close pairs are distinguished by finer centres.
Array<uint8_t> told_apart(std::span<const Vec3> points, const Triangulation& t,
                          std::span<const CellPair> pairs, const Run& run) {
  auto apart = array<uint8_t>(pairs.size(), 0, run);
  parallel_for(static_cast<int64_t>(pairs.size()), run, [&](int64_t i) {
    const Circumcentre a = fine_centre(points, t.cells[pairs[i].first]),
                       b = fine_centre(points, t.cells[pairs[i].second]);
    apart[i] = distance(a.centre, b.centre) > a.error + b.error;
  });
  return apart;
}

// Computes finer centres for all cells that close pairs connect to a distinguished one, so that it
// is distinguished from all of them.
void refine(std::span<const Vec3> points, const Triangulation& t, std::span<const CellPair> pairs,
            std::span<const uint8_t> apart, Centres& centres, const Run& run) {
  UnionFind close(t.cells.size(), run);
  unite(close, pairs);
  auto finer = array<uint8_t>(t.cells.size(), 0, run);
  for (size_t i = 0; i < pairs.size(); ++i) finer[close.find(pairs[i].first)] |= apart[i];
  for (const auto& [a, b] : pairs) {
    for (const int32_t cell : {a, b}) {
      if (finer[close.find(cell)]) centres.centre[cell] = fine_centre(points, t.cells[cell]).centre;
    }
  }
}

// Returns the neighbours with one Voronoi vertex. Finer bounds may distinguish those that the first
// bounds do not: a facet that is narrower than a coarse bound is still a facet.
Array<CellPair> same_vertex_pairs(std::span<const Vec3> points, const Triangulation& t,
                                  Centres& centres, const Run& run) {
  Array<CellPair> pairs = close_pairs(t, centres, run);
  const Array<uint8_t> apart = told_apart(points, t, pairs, run);
  if (std::find(apart.begin(), apart.end(), 1) == apart.end()) return pairs;
  refine(points, t, pairs, apart, centres, run);
  size_t kept = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (!apart[i]) pairs[kept++] = pairs[i];
  }
  pairs.resize(kept);
  return pairs;
}

// Returns the pairs of cocircular hull triangles; they share a Voronoi ray, with the same origin
// and direction.
std::vector<CellPair> same_ray_pairs(const Triangulation& t, const Centres& centres,
                                     UnionFind& vertices) {
  std::vector<CellPair> pairs;
  for (int32_t c = t.finite_cells; c < t.cell_count(); ++c) {
    const int32_t origin = vertices.find(t.neighbors[c][0]);
    for (int i = 1; i < 4; ++i) {
      const int32_t n = t.neighbors[c][i];
      if (n > c && vertices.find(t.neighbors[n][0]) == origin && indistinguishable(centres, c, n)) {
        pairs.emplace_back(c, n);
      }
    }
  }
  return pairs;
}

}  // namespace

Voronoi voronoi(std::span<const Vec3> points, const Triangulation& t, const Run& run) {
  begin_stage(run.progress, "Voronoi vertices", 0.58, 0.66);
  Centres found = centres(points, t, run);
  UnionFind vertices(t.cells.size(), run);
  unite(vertices, same_vertex_pairs(points, t, found, {run.threads, nullptr, run.arena}));
  unite(vertices, same_ray_pairs(t, found, vertices));
  return {std::move(found.centre), std::move(vertices).representatives()};
}

}  // namespace medial
