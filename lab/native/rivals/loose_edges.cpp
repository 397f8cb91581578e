// SPDX-License-Identifier: GPL-3.0-or-later
#include "rivals/loose_edges.h"

#include <set>

#include "delaunay/circumcentre.h"
#include "delaunay/edges.h"
#include "delaunay/face_set.h"

namespace medial {
namespace {

// Returns the diameter of the smallest ball that holds a triangle. Its diameter is the longest
// side, unless the triangle is acute.
double smallest_diameter(const Vec3& p, const Vec3& q, const Vec3& r) {
  std::array<double, 3> sides = {distance(p, q), distance(q, r), distance(r, p)};
  std::sort(sides.begin(), sides.end());
  const auto& [a, b, c] = sides;
  return a * a + b * b <= c * c ? c : 2 * circumradius(p, q, r);
}

// This is a Voronoi edge: the rows of its samples, ascending, and its ends.
struct LooseEdge {
  Triangle rows;
  Edge ends;

  friend bool operator<(const LooseEdge& a, const LooseEdge& b) { return a.rows < b.rows; }
};

class Finder {
 public:
  Finder(const SizeSelection& selection, std::span<const Edge> generators,
         std::span<const int32_t> row)
      : selection_(selection), s_(selection.facets()), generators_(generators), row_(row) {}

  // Appends the triangles of a cell that no lower cell sees.
  void append(int32_t cell, std::vector<LooseEdge>& out, std::vector<int32_t>& ring) const {
    for (int slot = 0; slot < 4; ++slot) {
      const int32_t across = s_.triangulation.neighbors[cell][slot];
      if (across < cell || s_.triangulation.is_infinite(across)) continue;
      const Triangle t = corners(s_.triangulation, {cell, slot});
      if (!is_wide(t) || !is_inside(t, cell, ring)) continue;
      Triangle rows = {row_[t[0]], row_[t[1]], row_[t[2]]};
      std::sort(rows.begin(), rows.end());
      if (has_facet(rows)) continue;
      const auto [low, high] = std::minmax(s_.voronoi.vertex[cell], s_.voronoi.vertex[across]);
      if (low != high) out.push_back({rows, {low, high}});
    }
  }

 private:
  bool is_wide(const Triangle& t) const {
    const auto samples = static_cast<int32_t>(row_.size());
    if (std::any_of(t.begin(), t.end(), [&](int32_t p) { return p >= samples; })) return false;
    const std::span<const Vec3> at = s_.points;
    return smallest_diameter(at[t[0]], at[t[1]], at[t[2]]) >= selection_.least_length();
  }

  // Returns whether the three facets around the edge are bounded and lie on the wanted side.
  bool is_inside(const Triangle& t, int32_t cell, std::vector<int32_t>& ring) const {
    const Side side = selection_.wanted().side;
    for (int i = 0; i < 3; ++i) {
      ring_of_cells(s_.triangulation, {t[i], t[(i + 1) % 3]}, cell, ring);
      const auto is_infinite = [&](int32_t c) { return s_.triangulation.is_infinite(c); };
      if (std::any_of(ring.begin(), ring.end(), is_infinite)) return false;
      if (side != Side::both && facet_side(ring, s_.sides) != side) return false;
    }
    return true;
  }

  bool has_facet(const Triangle& rows) const {
    const auto has = [&](int i, int j) {
      return std::binary_search(generators_.begin(), generators_.end(), Edge{rows[i], rows[j]});
    };
    return has(0, 1) || has(0, 2) || has(1, 2);
  }

  const SizeSelection& selection_;
  const Facets& s_;
  std::span<const Edge> generators_;
  std::span<const int32_t> row_;
};

}  // namespace

std::vector<Edge> loose_edges(const SizeSelection& selection, std::span<const Edge> generators,
                              std::span<const int32_t> row, const Run& run) {
  const Finder finder(selection, generators, row);
  std::vector<std::vector<int32_t>> rings(run.threads);
  auto found =
      parallel_append<LooseEdge>(selection.facets().triangulation.finite_cells, run,
                                 [&](int64_t cell, std::vector<LooseEdge>& out, int worker) {
                                   finder.append(static_cast<int32_t>(cell), out, rings[worker]);
                                 });
  std::sort(found.begin(), found.end());
  std::vector<Edge> edges;
  std::set<Edge> known;  // cocircular triangles share an edge
  for (const LooseEdge& edge : found) {
    if (known.insert(edge.ends).second) edges.push_back(edge.ends);
  }
  return edges;
}

}  // namespace medial
