#include "umbrellas.h"

namespace medial {
namespace {

enum class Height { below, above, level };

// On which side of the tangent plane a Voronoi vertex lies; a vertex in the plane counts as above,
// so that of the edges that meet there those from below cross it, and the umbrella stays a disc.
// For an infinite cell: where its ray leads.
Height height(const Vec3& p, const Vec3& pole, int32_t cell, const Triangulation& t,
              const Voronoi& voronoi) {
  if (t.is_infinite(cell)) {
    const double h = dot(voronoi.centre[cell], pole);
    return h > 0 ? Height::above : h < 0 ? Height::below : Height::level;
  }
  return dot(voronoi.centre[cell] - p, pole) >= 0 ? Height::above : Height::below;
}

bool cross_the_plane(Height a, Height b) {
  return a != b && a != Height::level && b != Height::level;
}

void append_umbrella(const Vec3& p, int32_t id, const Vec3& pole, std::span<const int32_t> cells,
                     const Triangulation& t, const Voronoi& voronoi,
                     std::vector<std::array<int32_t, 2>>& out) {
  for (const int32_t cell : cells) {
    if (t.is_infinite(cell)) break;  // a ray is met from its finite end
    const Height here = height(p, pole, cell, t, voronoi);
    for (int i = 0; i < 4; ++i) {
      const int32_t next = t.neighbors[cell][i];
      if (next < cell || t.cells[cell][i] == id) continue;
      if (!cross_the_plane(here, height(p, pole, next, t, voronoi))) continue;
      std::array<int32_t, 2> others{};
      int found = 0;
      for (int j = 0; j < 4; ++j) {
        if (j != i && t.cells[cell][j] != id) others[found++] = t.cells[cell][j];
      }
      out.push_back(others);
    }
  }
}

}  // namespace

Umbrellas umbrellas(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
                    const Csr<int32_t>& incident, const Poles& poles, const Run& run) {
  begin_stage(run.progress, "Umbrellas", 0.72, 0.8);
  Umbrellas result;
  result.offsets.assign(static_cast<size_t>(incident.size()) + 1, 0);
  result.items =
      parallel_append<std::array<int32_t, 2>>(incident.size(), run, [&](int64_t p, auto& out, int) {
        const size_t before = out.size();
        append_umbrella(points[p], static_cast<int32_t>(p), poles.vector[p], incident[p], t,
                        voronoi, out);
        result.offsets[p] = static_cast<int64_t>(out.size() - before);
      });
  counts_to_offsets(result.offsets);
  return result;
}

}  // namespace medial
