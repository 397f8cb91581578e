// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/crisp_parts.h"

namespace medial {
namespace {

// Facets of K1 that noise of the samples may have caused keep their places.
bool is_certain(const Thickness& value) {
  return value.sheet > 0 && value.spacings > 1 && value.erosion > 0;
}

// Places a vertex of facets where its ball touches its walls.
void place(CrispState& state, int32_t v) {
  Touch found;
  Walls before;
  for (const bool thorough : {false, true}) {
    const Walls walls = walls_at(state, v, thorough);
    if (walls.count < 2) return;
    if (walls == before) break;
    found = touch(state, v, walls, state.complex.position[v]);
    if (found.radius > 0) break;
    before = walls;
  }
  state.made.place[v] = found.radius > 0 ? Placing::touching : Placing::refused;
  if (!(found.radius > 0)) return;
  state.take(v, found);
}

}  // namespace

CrispState::CrispState(const InnerComplex& of, const Triangulation& cells,
                       const SamplesOnFaces& on_faces, std::span<const Thickness> values,
                       std::span<const double> sines, std::span<const uint8_t> selected,
                       const Run& whole)
    : complex(of),
      triangulation(cells),
      samples(on_faces),
      sine(sines),
      run{whole.threads, whole.progress, whole.arena, false},
      progress(whole.progress) {
  find_facets(values);
  find_rims();
  find_hidden(selected);
  made.position = {complex.position.begin(), complex.position.end()};
  made.radius = {complex.radius.begin(), complex.radius.end()};
  made.place = Array<Placing>(complex.cell.size(), Placing::voronoi);
  walls = array<Walls>(complex.cell.size(), Walls{}, run);
}

// Lists the facets of K1 at each vertex, and counts those at each edge.
void CrispState::find_facets(std::span<const Thickness> values) {
  for (int32_t f = 0; f < complex.facets(); ++f) {
    if (is_certain(values[f])) facets.push_back(f);
  }
  facets_at.offsets = array<int64_t>(complex.cell.size() + 1, 0, run);
  edge_uses = array<uint8_t>(complex.ends.size(), 0, run);
  for_corners([&](int32_t, const Corner& c) {
    ++facets_at.offsets[c.vertex];
    if (edge_uses[c.edge] < 3) ++edge_uses[c.edge];
  });
  counts_to_offsets(facets_at.offsets);
  facets_at.items = array<int32_t>(static_cast<size_t>(facets_at.offsets.back()), run);
  std::vector<int64_t> next(facets_at.offsets.begin(), facets_at.offsets.end());
  for_corners([&](int32_t f, const Corner& c) { facets_at.items[next[c.vertex]++] = f; });
}
void CrispState::find_rims() {
  on_rim = array<uint8_t>(complex.cell.size(), 0, run);
  for (size_t e = 0; e < complex.ends.size(); ++e) {
    if (edge_uses[e] != 1) continue;
    for (const int32_t v : complex.ends[e]) on_rim[v] = 1;
  }
}

// Lists the pairs of samples that selected facets without area separate at a vertex.
void CrispState::find_hidden(std::span<const uint8_t> selected) {
  for (size_t i = 0; i < complex.shrunk.size(); ++i) {
    if (!selected[i]) continue;
    const ShrunkFacet& s = complex.shrunk[i];
    hidden.push_back({s.vertex, s.generators[0], s.generators[1]});
    if (s.edge < 0) continue;
    for (const int32_t v : complex.ends[s.edge]) {
      hidden.push_back({v, s.generators[0], s.generators[1]});
    }
  }
  std::sort(hidden.begin(), hidden.end());
}

double CrispState::spacing_at(int32_t v) const {
  double most = 0;
  for (const int32_t f : facets_at[v]) {
    for (const int32_t s : complex.generators[f]) most = std::max(most, samples.spacing(s));
  }
  return most;
}

void CrispState::take(int32_t v, const Touch& found) {
  made.position[v] = found.position;
  made.radius[v] = found.radius;
  walls[v] = found.walls;
}

CrispPlaces crisp_places(const InnerComplex& complex, const Triangulation& triangulation,
                         const SamplesOnFaces& samples, std::span<const Thickness> facets,
                         std::span<const double> sine, std::span<const uint8_t> selected,
                         const Run& run) {
  begin_stage(run.progress, "Crisp places", kBarOfCrispPlaces, 1);
  CrispState state(complex, triangulation, samples, facets, sine, selected, run);
  CreaseRims creases(state);
  parallel_for(
      complex.vertices(), {run.threads, state.progress, run.arena},
      [&](int64_t id) {
        const auto v = static_cast<int32_t>(id);
        if (state.facets_at[v].empty()) return;
        const bool on_crease = state.on_rim[v] && creases.onto_crease(v);
        if (!on_crease) place(state, v);
      },
      256);
  creases.reach_corners();
  return std::move(state.made);
}

Array<uint8_t> vertices_on_creases(const InnerComplex& complex, const Triangulation& triangulation,
                                   const SamplesOnFaces& samples, std::span<const Thickness> facets,
                                   const Run& run) {
  Array<uint8_t> found(complex.cell.size(), 0);
  if (samples.creases().empty()) return found;
  const Run quiet{run.threads, nullptr, run.arena};
  const std::vector<uint8_t> none(complex.shrunk.size(), 0);
  CrispState state(complex, triangulation, samples, facets, {}, none, quiet);
  CreaseRims creases(state);
  parallel_for(complex.vertices(), quiet, [&](int64_t v) {
    found[v] = state.on_rim[v] && creases.onto_crease(static_cast<int32_t>(v)) &&
               state.made.place[v] >= Placing::crease;
  });
  return found;
}

}  // namespace medial
