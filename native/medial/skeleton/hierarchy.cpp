#include "skeleton/hierarchy.h"

#include "skeleton/bubbles.h"
#include "skeleton/fringe.h"
#include "skeleton/limbs.h"
#include "skeleton/sheets.h"

namespace medial {
namespace {

// Per facet: thickness in units that may differ from facet to facet.
template <typename Unit>
Array<float> in_units(std::span<const double> thickness, const Run& run, const Unit& unit) {
  auto result = array<float>(thickness.size(), run);
  parallel_for(static_cast<int64_t>(thickness.size()), run, [&](int64_t f) {
    const double t = thickness[f];
    result[f] = t > 0 && t < HUGE_VAL ? static_cast<float>(t / unit(f)) : static_cast<float>(t);
  });
  return result;
}

// In memory of its own, beside the arena.
template <typename T>
Array<T> kept(const Array<T>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

Hierarchy::Hierarchy(const Samples& samples, const Facets& facets, const Thresholds& thresholds,
                     const Run& run)
    : threads_(run.threads) {
  Stopwatch watch(timings_);
  const Run quiet{run.threads, nullptr, run.arena};
  begin_stage(run.progress, "Inner complex", 0, 0.2);
  InnerComplex complex =
      inner_complex(samples, facets.triangulation, facets.voronoi, facets.edges, facets.sides, run);
  watch.lap("complex");
  begin_stage(run.progress, "Fringe", 0.2, 0.4);
  const FacetWeights weight(facets, thresholds);
  Collapse collapse = whole(complex, weight, quiet);
  open_bubbles(complex, weight, collapse, run);
  peel_facets(complex, weight, collapse, run);
  peel_wires(complex, collapse, run);
  watch.lap("fringe");
  begin_stage(run.progress, "Fire", 0.4, 0.7);
  const Sheets sheets = find_sheets(complex, collapse, quiet);
  watch.lap("sheets");
  Burning burning = burn(complex, facets.points, collapse, run);
  watch.lap("fire");
  begin_stage(run.progress, "Wires", 0.7, 0.8);
  const Wires wires = burn_wires(complex, burning.times, collapse, run);
  burning.times = {};
  watch.lap("wires");
  begin_stage(run.progress, "Values", 0.8, 1);
  parts_.limb = kept(limb_values(complex, collapse, wires, run));
  parts_.erosion = with_vertices(complex, collapse, wires, kept(burning.erosion), quiet);
  throw_if_cancelled(run.progress);
  const auto shares = in_units(burning.thickness, quiet, [&](int64_t) { return complex.diagonal; });
  parts_.sheet = with_vertices(complex, collapse, wires,
                               kept(drop_values(complex, collapse, sheets, shares, quiet)), quiet);
  throw_if_cancelled(run.progress);
  const auto& spacing = facets.significance.spacing;
  const auto spacings = in_units(burning.thickness, quiet, [&](int64_t f) {
    const auto& [p, q] = complex.generators[f];
    return 0.5 * (spacing[p] + spacing[q]);
  });
  parts_.spacings =
      with_vertices(complex, collapse, wires,
                    kept(drop_values(complex, collapse, sheets, spacings, quiet)), quiet);
  watch.lap("values");
  parts_.outside =
      outside_components(complex, samples.count(), facets.triangulation, facets.edges, quiet);
  betti_ = betti_of(complex, parts_.outside, quiet);
  watch.lap("betti");
  parts_.partner = kept(collapse.partner);
  parts_.row = samples.row;
  parts_.complex = std::move(complex);
  advance(run.progress, 1);
}

Level Hierarchy::extract(const LevelThresholds& thresholds, Progress* progress) const {
  return level(parts_, thresholds, {threads_, progress});
}

}  // namespace medial
