// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/complex.h"

#include <climits>

#include "base/atomic.h"
#include "collapse/shrink.h"

namespace medial {
namespace {

bool is_inner(const CellSides& sides, int32_t cell) { return sides[cell] == Side::inner; }

// Numbers the inner cells; all others get -1.
Array<int32_t> number_cells(InnerComplex& complex, const Triangulation& t, const CellSides& sides,
                            const Run& run) {
  parallel_append_to(complex.cell, t.finite_cells, run, [&](int64_t c, auto& out, int) {
    if (is_inner(sides, static_cast<int32_t>(c))) out.push_back(static_cast<int32_t>(c));
  });
  auto number = array<int32_t>(t.cells.size(), -1, run);
  parallel_for(complex.vertices(), run,
               [&](int64_t v) { number[complex.cell[v]] = static_cast<int32_t>(v); });
  return number;
}

// Places the vertices. Returns for each one the lowest vertex in the same place.
Array<int32_t> place_vertices(InnerComplex& complex, const Samples& samples, const Triangulation& t,
                              const Voronoi& voronoi, std::span<const int32_t> number,
                              const Run& run) {
  const auto count = static_cast<size_t>(complex.vertices());
  complex.position.resize(count);
  complex.radius.resize(count);
  auto place = array<int32_t>(count, run);
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    const int32_t cell = complex.cell[v], lowest = voronoi.vertex[cell];
    complex.position[v] = voronoi.centre[cell];
    complex.radius[v] = distance(voronoi.centre[cell], samples.points[t.cells[cell][0]]);
    // The lowest cell in this place may be an outer one; then each inner cell is by itself.
    place[v] = number[lowest] < 0 ? static_cast<int32_t>(v) : number[lowest];
  });
  return place;
}

// Holds the edges at each vertex, in the slots of its cell's neighbours; -1 means no edge.
using EdgesAtVertex = Array<Cell>;

// Numbers the edges in the order of their lower vertices.
EdgesAtVertex number_edges(InnerComplex& complex, const Triangulation& t,
                           std::span<const int32_t> number, const Run& run) {
  const auto above = [&](int64_t v, int slot) {
    const int32_t other = number[t.neighbors[complex.cell[v]][slot]];
    return other > v ? other : -1;
  };
  auto first = array<int32_t>(static_cast<size_t>(complex.vertices()) + 1, 0, run);
  auto edges_at = array<Cell>(static_cast<size_t>(complex.vertices()), Cell{-1, -1, -1, -1}, run);
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    for (int slot = 0; slot < 4; ++slot) first[v] += above(v, slot) >= 0;
  });
  counts_to_offsets(first);
  complex.ends.resize(static_cast<size_t>(first.back()));
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    int32_t next = first[v];
    for (int slot = 0; slot < 4; ++slot) {
      const int32_t other = above(v, slot);
      if (other < 0) continue;
      complex.ends[next] = {static_cast<int32_t>(v), other};
      edges_at[v][slot] = next;
      edges_at[other][slot_of(t.neighbors[complex.cell[other]], complex.cell[v])] = next++;
    }
  });
  return edges_at;
}

// Holds the facets of some Delaunay edges.
struct Rings {
  Array<Corner> corners;
  Array<int32_t> sizes, duals;
};

// Walks the rings of some Delaunay edges, one after the other.
class RingWalker {
 public:
  RingWalker(const Triangulation& t, const Edges& edges, const EdgesAtVertex& edges_at,
             std::span<const int32_t> number)
      : t_(t), edges_(edges), edges_at_(edges_at), number_(number) {}

  // Appends the facet of a Delaunay edge if all its cells are inner.
  void append(int32_t edge, Rings& out) {
    const size_t before = out.corners.size();
    const bool inner =
        walk_ring(t_, edges_.ends[edge], edges_.cell[edge], [&](int32_t cell, int leave) {
          const int32_t v = number_[cell];
          if (v < 0) return false;
          out.corners.push_back({v, edges_at_[v][leave]});
          return true;
        });
    if (!inner) {
      out.corners.resize(before);
      return;
    }
    out.sizes.push_back(static_cast<int32_t>(out.corners.size() - before));
    out.duals.push_back(edge);
  }

 private:
  const Triangulation& t_;
  const Edges& edges_;
  const EdgesAtVertex& edges_at_;
  std::span<const int32_t> number_;
};

std::vector<Rings> walk_rings(const Triangulation& t, const Edges& edges,
                              const EdgesAtVertex& edges_at, std::span<const int32_t> number,
                              const Run& run) {
  std::vector<Rings> parts(static_cast<size_t>((edges.count() + kGrain - 1) / kGrain));
  std::vector<Rings> scratch(run.threads);
  parallel_chunks(edges.count(), run, [&](int64_t begin, int64_t end, int worker) {
    RingWalker walker(t, edges, edges_at, number);
    Rings& own = scratch[worker];
    own.corners.clear();
    own.sizes.clear();
    own.duals.clear();
    for (int64_t e = begin; e < end; ++e) walker.append(static_cast<int32_t>(e), own);
    parts[static_cast<size_t>(begin / kGrain)] = {pack(own.corners, run), pack(own.sizes, run),
                                                  pack(own.duals, run)};
  });
  return parts;
}

void require_few_corners(size_t corners) {
  if (corners > INT_MAX) {
    throw InvalidInputError("Expected fewer than 2^31 corners of inner facets, found " +
                            std::to_string(corners) + "; thin the points.");
  }
}

void join_rings(InnerComplex& complex, std::vector<Rings> parts, const Edges& edges,
                const Run& run) {
  std::vector<size_t> facet{0}, corner{0};
  for (const Rings& part : parts) {
    facet.push_back(facet.back() + part.duals.size());
    corner.push_back(corner.back() + part.corners.size());
  }
  require_few_corners(corner.back());
  complex.generators.resize(facet.back());
  complex.dual.resize(facet.back());
  complex.offsets.resize(facet.back() + 1);
  complex.corners.resize(corner.back());
  complex.offsets.back() = static_cast<int32_t>(corner.back());
  const auto copy = [&](int64_t i) {
    Rings& part = parts[i];
    std::copy(part.corners.begin(), part.corners.end(), complex.corners.data() + corner[i]);
    auto at = static_cast<int32_t>(corner[i]);
    for (size_t k = 0; k < part.duals.size(); ++k) {
      const size_t f = facet[i] + k;
      complex.dual[f] = part.duals[k];
      complex.generators[f] = edges.ends[part.duals[k]];
      complex.offsets[f] = at;
      at += part.sizes[k];
    }
    part = {};
  };
  parallel_for(static_cast<int64_t>(parts.size()), run, copy, 1);
}

// Finds the samples that only inner cells touch.
void find_bubbles(InnerComplex& complex, int32_t samples, const Triangulation& t,
                  std::span<const int32_t> number, const Run& run) {
  auto touched = array<uint8_t>(static_cast<size_t>(samples), 0, run);
  parallel_for(t.cell_count(), run, [&](int64_t c) {
    if (number[c] >= 0) return;
    for (const int32_t p : t.cells[c]) {
      if (p >= 0 && p < samples) shared_store(touched[p], uint8_t{1});
    }
  });
  for (int32_t p = 0; p < samples; ++p) {
    if (!touched[p]) complex.bubbles.push_back(p);
  }
}

}  // namespace

InnerComplex inner_complex(const Samples& samples, const Triangulation& t, const Voronoi& voronoi,
                           const Edges& edges, const CellSides& sides, const Run& run) {
  InnerComplex complex;
  const auto number = number_cells(complex, t, sides, run);
  const auto place = place_vertices(complex, samples, t, voronoi, number, run);
  {
    const EdgesAtVertex edges_at = number_edges(complex, t, number, run);
    join_rings(complex, walk_rings(t, edges, edges_at, number, run), edges, run);
  }
  find_bubbles(complex, samples.count(), t, number, run);
  complex.diagonal =
      length(box_of({samples.points.data(), static_cast<size_t>(samples.count())}).extent());
  return shrink(std::move(complex), place, run);
}

}  // namespace medial
