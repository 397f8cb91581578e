// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/even_rims.h"

#include "base/rows.h"
#include "exact/even_creases.h"
#include "exact/even_places.h"
#include "levels/even_level.h"
#include "remesh/remesh.h"

namespace medial {
namespace {

constexpr int kRings = 4;       // of triangles beside new rims, which change
constexpr int kRimRounds = 12;  // teeth of left out spikes are several triangles wide

// Returns for each vertex of a complex whether some, but not all facets of an edge there are left.
std::vector<uint8_t> beside_gaps(const InnerComplex& complex, const Alive& alive) {
  std::vector<int32_t> all(static_cast<size_t>(complex.edges())), left(all);
  for (int32_t f = 0; f < complex.facets(); ++f) {
    for (const Corner& c : complex.ring(f)) {
      ++all[c.edge];
      left[c.edge] += alive.facet[f];
    }
  }
  std::vector<uint8_t> found(complex.cell.size(), 0);
  for (int32_t e = 0; e < complex.edges(); ++e) {
    if (left[e] == 0 || left[e] == all[e]) continue;
    for (const int32_t v : complex.ends[e]) found[v] = 1;
  }
  return found;
}

// Returns the mesh of a level.
EvenMesh mesh_of(const Level& level, const EvenVertices& known) {
  const auto count = static_cast<int32_t>(level.vertices.size());
  std::vector<Triangle> triangles;
  for (size_t c = 0; c + 2 < level.face_vertices.size(); c += 3) {
    const int32_t* corner = level.face_vertices.data() + c;
    triangles.push_back({corner[0], corner[1], corner[2]});
  }
  std::vector<uint8_t> is_node = rows_of(known.is_end, level.vertex_of);
  for (const int32_t v : level.points) is_node[v] = 1;
  std::vector<int32_t> source = all_rows(triangles.size());
  std::vector<Vec3> normal;
  for (const auto& [a, b, c] : triangles) {
    const auto& p = level.vertices;
    normal.push_back(normalized(cross(p[b] - p[a], p[c] - p[a])));
  }
  return {SheetComplex(count, std::move(triangles), level.wires, is_node),
          {level.vertices.begin(), level.vertices.end()},
          rows_of(known.target, level.vertex_of),
          all_rows(level.vertices.size()),
          rows_of(known.held, level.vertex_of),
          std::move(source),
          std::move(normal)};
}

// Lets only vertices change that are near some.
void hold_others(EvenMesh& even, std::vector<uint8_t> near) {
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<uint8_t> wider(near);
    for (int32_t v = 0; v < even.mesh.vertices(); ++v) {
      if (near[v]) even.mesh.for_corners(v, [&](int32_t other) { wider[other] = 1; });
    }
    near = std::move(wider);
  }
  for (size_t v = 0; v < near.size(); ++v) {
    if (!near[v]) even.held[v] = kStill;
  }
}

}  // namespace

void smooth_new_rims(Level& level, const Hierarchy::Parts& h, const Alive& alive, const Run& run) {
  const std::vector<uint8_t> gaps = beside_gaps(h.complex, alive);
  std::vector<uint8_t> near = rows_of(gaps, level.vertex_of);
  if (std::find(near.begin(), near.end(), 1) == near.end()) return;
  EvenMesh even = mesh_of(level, h.even->vertices);
  hold_others(even, std::move(near));
  const SamplesOnFaces* faces = h.on_faces.get();
  const RemeshOptions options{true, kChordOfLine * h.complex.diagonal, onto_creases(faces)};
  for (int round = 0; round < kRimRounds; ++round) remesh(even, options, run);
  if (!faces) return void(write_even(even, {}, {}, h, level, run));
  const auto generators = rows_of(h.complex.generators, level.facet_of);
  EvenPlaces places(even, *faces, generators, level.wires, run);
  places.start_from(level.place, level.radius);
  places.finish();
  write_even(even, places.placing(), places.radius(), h, level, run);
}

}  // namespace medial
