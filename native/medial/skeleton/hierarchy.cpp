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

// Of facets, from what they are in three respects.
Array<Thickness> joined(std::span<const float> sheet, std::span<const float> spacings,
                        std::span<const float> erosion, const Run& run) {
  Array<Thickness> all(erosion.size());
  parallel_for(static_cast<int64_t>(all.size()), run, [&](int64_t f) {
    all[f] = {sheet[f], spacings[f], erosion[f]};
  });
  return all;
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
  find_values(complex, collapse, sheets, burning, wires, facets.significance.spacing, run);
  watch.lap("values");
  parts_.outside =
      outside_components(complex, samples.count(), facets.triangulation, facets.edges, quiet);
  betti_ = betti_of(complex, parts_.outside, quiet);
  watch.lap("betti");
  parts_.partner = std::move(collapse.partner);
  parts_.row = samples.row;
  complex.dual = {};  // it means nothing without the analysis
  parts_.complex = std::move(complex);
  advance(run.progress, 1);
}

void Hierarchy::find_values(const InnerComplex& complex, const Collapse& collapse,
                            const Sheets& sheets, const Burning& burning, const Wires& wires,
                            std::span<const double> spacing, const Run& run) {
  const Run quiet{run.threads, nullptr, run.arena}, alone{1, nullptr, run.arena};
  const auto shares = in_units(burning.thickness, quiet, [&](int64_t) { return complex.diagonal; });
  const auto spacings = in_units(burning.thickness, quiet, [&](int64_t f) {
    const auto& [p, q] = complex.generators[f];
    return 0.5 * (spacing[p] + spacing[q]);
  });
  Array<float> sheet_values, spacing_values;
  // Each of these works by itself.
  const std::array<std::function<void()>, 3> work{
      [&] { parts_.limb = kept(limb_values(complex, collapse, wires, alone)); },
      [&] { sheet_values = drop_values(complex, collapse, sheets, shares, alone); },
      [&] { spacing_values = drop_values(complex, collapse, sheets, spacings, alone); }};
  parallel_for(
      3, run, [&](int64_t i) { work[i](); }, 1);
  parts_.values =
      with_vertices(complex, collapse, wires,
                    joined(sheet_values, spacing_values, burning.erosion, quiet), quiet);
}

Level Hierarchy::extract(const LevelThresholds& thresholds, Progress* progress) const {
  return level(parts_, thresholds, {threads_, progress});
}

}  // namespace medial
