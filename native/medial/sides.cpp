#include "sides.h"

#include "winding_number.h"

namespace medial {
namespace {

// The decided neighbour, of a cell from `begin` on, whose Voronoi vertex is nearest; -1: none.
int32_t nearest_decided(int32_t cell, int64_t begin, const Triangulation& t,
                        const Voronoi& voronoi) {
  int32_t nearest = -1;
  double least = HUGE_VAL;
  for (const int32_t n : t.neighbors[cell]) {
    if (n < begin || n >= cell) continue;
    const double d = squared_length(voronoi.centre[n] - voronoi.centre[cell]);
    if (d < least) {
      least = d;
      nearest = n;
    }
  }
  return nearest;
}

// One Voronoi vertex, one side.
void share_sides(const Triangulation& t, const Voronoi& voronoi, CellSides& sides, const Run& run) {
  parallel_for(t.finite_cells, {run.threads, nullptr}, [&](int64_t c) {
    if (voronoi.vertex[c] != c) sides[c] = sides[voronoi.vertex[c]];
  });
}

// Sum of the cosines between the outward normals of a cell's corners and the directions to its
// Voronoi vertex.
double vote(std::span<const Vec3> points, std::span<const Vec3> normals, const Cell& cell,
            const Vec3& centre) {
  double sum = 0;
  for (const int32_t p : cell) {
    if (static_cast<size_t>(p) < normals.size()) {
      sum += dot(normals[p], normalized(centre - points[p]));
    }
  }
  return sum;
}

}  // namespace

CellSides sides_from_surface(std::span<const Vec3> points, const Surface& surface,
                             const Triangulation& t, const Voronoi& voronoi, const Run& run) {
  begin_stage(run.progress, "Inside and outside", 0.9, 0.99);
  const WindingNumber winding(points, surface.triangles, surface.boundary, run.progress);
  CellSides sides(t.cells.size(), static_cast<uint8_t>(Side::outer));
  // Along a Voronoi edge there is little to cross: most vertices are told from a neighbour of the
  // same chunk.
  parallel_chunks(t.finite_cells, run, [&](int64_t begin, int64_t end, int) {
    std::vector<int> closed;
    for (auto c = static_cast<int32_t>(begin); c < end; ++c) {
      const Vec3& here = voronoi.centre[c];
      const int32_t known = nearest_decided(c, begin, t, voronoi);
      closed.push_back(
          known < 0 ? winding.closed(here)
                    : winding.closed_from(voronoi.centre[known], closed[known - begin], here));
      if (winding.is_inside(here, closed.back())) sides[c] = static_cast<uint8_t>(Side::inner);
    }
  });
  share_sides(t, voronoi, sides, run);
  return sides;
}

CellSides sides_from_normals(std::span<const Vec3> points, std::span<const Vec3> normals,
                             const Triangulation& t, const Voronoi& voronoi, const Run& run) {
  begin_stage(run.progress, "Inside and outside", 0.9, 0.99);
  CellSides sides(t.cells.size(), static_cast<uint8_t>(Side::outer));
  parallel_for(t.finite_cells, run, [&](int64_t c) {
    if (vote(points, normals, t.cells[c], voronoi.centre[c]) < 0)
      sides[c] = static_cast<uint8_t>(Side::inner);
  });
  share_sides(t, voronoi, sides, run);
  return sides;
}

CellSides sides_in_solid(std::span<const Vec3> points, std::span<const Vec3> normals,
                         const CellSides& solid, const Triangulation& t, const Voronoi& voronoi,
                         const Run& run) {
  CellSides sides(solid);
  parallel_for(t.finite_cells, run, [&](int64_t c) {
    const bool inner = solid[c] == static_cast<uint8_t>(Side::inner);
    if (inner && vote(points, normals, t.cells[c], voronoi.centre[c]) > 0)
      sides[c] = static_cast<uint8_t>(Side::outer);
  });
  return sides;
}

Side facet_side(std::span<const int32_t> ring, const CellSides& sides) {
  if (sides.empty()) return Side::both;
  size_t inner = 0;
  for (const int32_t cell : ring) inner += sides[cell] == static_cast<uint8_t>(Side::inner);
  return inner == ring.size() ? Side::inner : inner == 0 ? Side::outer : Side::crossing;
}

}  // namespace medial
