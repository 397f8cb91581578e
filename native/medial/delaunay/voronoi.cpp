// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/voronoi.h"

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
      // Positive orientation with the infinite vertex outside: the outward normal turns the other
      // way.
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

Array<CellPair> same_vertex_pairs(const Triangulation& t, const Centres& centres, const Run& run) {
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

// Cocircular hull triangles have one Voronoi ray: same origin, same direction.
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
  unite(vertices, same_vertex_pairs(t, found, {run.threads, nullptr, run.arena}));
  unite(vertices, same_ray_pairs(t, found, vertices));
  return {std::move(found.centre), std::move(vertices).representatives()};
}

}  // namespace medial
