// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

constexpr double kBarOfRims = 0.55, kBarOfFolds = 0.7;

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
  if (state.on_rim[v] && found.walls.count == 2)
    state.smooth_rim[v] = smooth_rim_of(state.samples.faces(), state.spacing_at(v), found);
}

}  // namespace

CrispState::CrispState(const InnerComplex& of, const Triangulation& cells,
                       const SamplesOnFaces& on_faces, std::span<const Thickness> values,
                       std::span<const double> sines, std::span<const uint8_t> selected,
                       std::span<const uint8_t> edges, const Run& whole)
    : complex(of),
      triangulation(cells),
      samples(on_faces),
      sine(sines),
      run{whole.threads, whole.progress, whole.arena, false},
      progress(whole.progress) {
  find_facets(values);
  find_rims();
  find_wires(edges);
  find_hidden(selected);
  made.position = {complex.position.begin(), complex.position.end()};
  made.radius = {complex.radius.begin(), complex.radius.end()};
  made.place = Array<Placing>(complex.cell.size(), Placing::voronoi);
  made.reach = samples.reach();
  made.tips = tips_of(samples.faces());
  walls = array<Walls>(complex.cell.size(), Walls{}, run);
  smooth_rim = array<SmoothRim>(complex.cell.size(), SmoothRim{}, run);
  stays = array<uint8_t>(complex.cell.size(), 0, run);
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
  on_seam = array<uint8_t>(complex.cell.size(), 0, run);
  std::vector<Edge> pairs;
  for (size_t e = 0; e < complex.ends.size(); ++e) {
    const auto& [a, b] = complex.ends[e];
    if (edge_uses[e] == 3) on_seam[a] = on_seam[b] = 1;
    if (edge_uses[e] != 1) continue;
    on_rim[a] = on_rim[b] = 1;
    pairs.push_back({a, b});
    pairs.push_back({b, a});
  }
  std::sort(pairs.begin(), pairs.end());
  beside = csr_of_pairs(pairs, complex.cell.size(), run);
}

void CrispState::find_wires(std::span<const uint8_t> edges) {
  for (size_t e = 0; e < edges.size(); ++e) {
    if (!edges[e] || edge_uses[e] > 0) continue;
    const auto& [a, b] = complex.ends[e];
    if (!facets_at[a].empty() && facets_at[b].empty()) wires.push_back({a, b});
    if (!facets_at[b].empty() && facets_at[a].empty()) wires.push_back({b, a});
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

void CrispState::end_at(int32_t v, const Vec3& place) {
  const auto foot = samples.faces().nearer(place, HUGE_VAL);
  if (!samples.are_near(foot->point)) return;
  made.position[v] = place;
  made.radius[v] = foot->distance;
  made.place[v] = Placing::rim;
}

bool CrispState::is_open_rim(int32_t v) const {
  const Placing place = made.place[v];
  if (!on_rim[v] || place >= Placing::crease || place == Placing::voronoi) return false;
  return place == Placing::rim ? made.radius[v] > 0 : !on_seam[v];
}

CrispPlaces crisp_places(const InnerComplex& complex, const Triangulation& triangulation,
                         const SamplesOnFaces& samples, std::span<const Thickness> facets,
                         std::span<const double> sine, std::span<const uint8_t> selected,
                         std::span<const uint8_t> edges, const Run& run) {
  begin_stage(run.progress, "Crisp places", kBarOfCrispPlaces, kBarOfRims);
  CrispState state(complex, triangulation, samples, facets, sine, selected, edges, run);
  CreaseRims creases(state);
  const Array<uint8_t> dense = dense_vertices(state);
  parallel_for(
      complex.vertices(), {run.threads, state.progress, run.arena},
      [&](int64_t id) {
        const auto v = static_cast<int32_t>(id);
        if (state.facets_at[v].empty()) return;
        const bool on_crease = state.on_rim[v] && creases.onto_crease(v);
        if (!on_crease && !dense[v]) place(state, v);
      },
      256);
  begin_stage(run.progress, "Rims", kBarOfRims, kBarOfFolds);
  settle_smooth_rims(state);
  end_fillets(state);
  order_rims(state);
  gather_focal_rims(state);
  creases.reach_corners();
  creases.smooth_zigzags();
  join_seams(state);
  end_wires(state);
  begin_stage(run.progress, "Folds", kBarOfFolds, 1);
  unfold(state);
  contract_folds(state);
  return std::move(state.made);
}

Array<uint8_t> vertices_on_creases(const InnerComplex& complex, const Triangulation& triangulation,
                                   const SamplesOnFaces& samples, std::span<const Thickness> facets,
                                   const Run& run) {
  Array<uint8_t> found(complex.cell.size(), 0);
  if (samples.creases().empty()) return found;
  const Run quiet{run.threads, nullptr, run.arena};
  const std::vector<uint8_t> none(complex.shrunk.size(), 0);
  CrispState state(complex, triangulation, samples, facets, {}, none, {}, quiet);
  CreaseRims creases(state);
  parallel_for(complex.vertices(), quiet, [&](int64_t v) {
    found[v] = state.on_rim[v] && creases.onto_crease(static_cast<int32_t>(v)) &&
               state.made.place[v] >= Placing::crease;
  });
  return found;
}

}  // namespace medial
