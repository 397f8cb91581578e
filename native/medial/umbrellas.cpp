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

// The corners of a cell's facet opposite to a slot that are not p.
std::array<int32_t, 2> others(const Cell& cell, int slot, int32_t p) {
  std::array<int32_t, 2> found{};
  int count = 0;
  for (int j = 0; j < 4; ++j) {
    if (j != slot && cell[j] != p) found[count++] = cell[j];
  }
  return found;
}

// Each Voronoi edge that crosses the plane is met once: from below.
void append_umbrella(const Vec3& p, int32_t id, const Vec3& pole, std::span<const int32_t> cells,
                     const Triangulation& t, const Voronoi& voronoi,
                     std::vector<std::array<int32_t, 2>>& out) {
  for (const int32_t cell : cells) {
    if (height(p, pole, cell, t, voronoi) != Height::below) continue;
    for (int i = 0; i < 4; ++i) {
      const int32_t next = t.neighbors[cell][i];
      if (t.cells[cell][i] == id || (t.is_infinite(cell) && t.is_infinite(next))) continue;
      if (height(p, pole, next, t, voronoi) == Height::above) {
        out.push_back(others(t.cells[cell], i, id));
      }
    }
  }
}

}  // namespace

Umbrellas umbrellas(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
                    const Csr<int32_t>& incident, const Run& run) {
  begin_stage(run.progress, "Poles and umbrellas", 0.68, 0.8);
  Umbrellas result;
  result.offsets = array<int64_t>(static_cast<size_t>(incident.size()) + 1, 0, run);
  result.items = array<std::array<int32_t, 2>>(0, run);
  parallel_append_to(result.items, incident.size(), run, [&](int64_t p, auto& out, int) {
    const size_t before = out.size();
    const Vec3 to_pole = pole(points[p], incident[p], t, voronoi);
    append_umbrella(points[p], static_cast<int32_t>(p), to_pole, incident[p], t, voronoi, out);
    result.offsets[p] = static_cast<int64_t>(out.size() - before);
  });
  counts_to_offsets(result.offsets);
  return result;
}

}  // namespace medial
