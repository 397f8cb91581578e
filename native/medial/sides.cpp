#include "sides.h"

#include "winding_number.h"

namespace medial {

CellSides sides_from_surface(std::span<const Vec3> points, const Surface& surface, const Triangulation& t,
                             const Voronoi& voronoi, const Run& run) {
  begin_stage(run.progress, "Inside and outside", 0.9, 0.99);
  const WindingNumber winding(points, surface.triangles, surface.boundary, run.progress);
  CellSides sides(t.cells.size(), static_cast<uint8_t>(Side::outer));
  parallel_for(t.finite_cells, run, [&](int64_t c) {
    const bool asked = voronoi.vertex[c] == c;  // one Voronoi vertex, one question, one side
    if (asked && winding.is_inside(voronoi.centre[c])) sides[c] = static_cast<uint8_t>(Side::inner);
  });
  parallel_for(t.finite_cells, {run.threads, nullptr}, [&](int64_t c) {
    if (voronoi.vertex[c] != c) sides[c] = sides[voronoi.vertex[c]];
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
