// SPDX-License-Identifier: GPL-3.0-or-later
#include "rivals/pole_balls.h"

namespace medial {
namespace {

constexpr int32_t kNone = -1;

// Returns the finite cell, ties by lowest id, whose Voronoi vertex is the farthest in the
// half-space of `direction`.
int32_t farthest(const Vec3& p, const Vec3& direction, std::span<const int32_t> cells,
                 const Triangulation& t, const Voronoi& voronoi) {
  int32_t found = kNone;
  double most = 0;
  for (const int32_t cell : cells) {
    if (t.is_infinite(cell)) continue;
    const Vec3 v = voronoi.centre[cell] - p;
    if (dot(v, direction) > 0 && squared_length(v) > most) most = squared_length(v), found = cell;
  }
  return found;
}

}  // namespace

MedialMesh pole_balls(const Samples& samples, const Triangulation& t, const Voronoi& voronoi,
                      const Csr<int32_t>& incident, const CellSides& sides, Side side,
                      const Run& run) {
  const Poles found = poles(samples.points, t, voronoi, incident, run);
  MedialMesh mesh;
  mesh.face_offsets = {0};
  std::vector<uint8_t> known(t.cells.size(), 0);
  const auto append = [&](int32_t cell) {
    if (cell == kNone || (side != Side::both && sides[cell] != side)) return;
    const int32_t vertex = voronoi.vertex[cell];
    if (known[vertex]) return;
    known[vertex] = 1;
    mesh.vertices.push_back(voronoi.centre[vertex]);
    mesh.radius.push_back(distance(voronoi.centre[vertex], samples.points[t.cells[vertex][0]]));
  };
  for (const int32_t p : samples_by_row(samples)) {
    const Vec3 &at = samples.points[p], &vector = found.vector[p];
    if (!found.unbounded[p]) append(farthest(at, vector, incident[p], t, voronoi));
    append(farthest(at, -vector, incident[p], t, voronoi));
  }
  return mesh;
}

}  // namespace medial
