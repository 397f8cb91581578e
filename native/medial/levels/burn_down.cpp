// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/burn_down.h"

#include "base/address_space.h"
#include "base/atomic.h"
#include "collapse/limbs.h"
#include "collapse/sheets.h"

namespace medial {
namespace {

// Returns the thickness per facet in units that may differ from facet to facet.
template <typename Unit>
Array<float> in_units(std::span<const double> thickness, const Run& run, const Unit& unit) {
  auto result = array<float>(thickness.size(), run);
  parallel_for(static_cast<int64_t>(thickness.size()), run, [&](int64_t f) {
    const double t = thickness[f];
    result[f] = t > 0 && t < HUGE_VAL ? static_cast<float>(t / unit(f)) : static_cast<float>(t);
  });
  return result;
}

// Joins the three measures of each facet.
Array<Thickness> joined(std::span<const float> sheet, std::span<const float> spacings,
                        std::span<const float> erosion, const Run& run) {
  Array<Thickness> all(erosion.size());
  parallel_for(static_cast<int64_t>(all.size()), run, [&](int64_t f) {
    all[f] = {sheet[f], spacings[f], erosion[f]};
  });
  return all;
}

// Copies values to memory outside the arena.
template <typename T>
Array<T> kept(const Array<T>& values) {
  return {values.begin(), values.end()};
}

void release(Arena* arena) {
  if (arena) arena->release();
}

// Runs works that do not need each other's results, on all threads.
void side_by_side(std::span<const std::function<void()>> works, const Run& run) {
  parallel_for(
      static_cast<int64_t>(works.size()), {run.threads, nullptr, run.arena},
      [&](int64_t i) { works[i](); }, 1);
}

// The thickness, in spacings, of sheets that lead into creases or lie between partners: the faces
// say that they are there, so they are no noise of the samples, however blunt the crease and
// however close the walls. No threshold but infinity drops them.
constexpr float kCertain = std::numeric_limits<float>::max();

// Returns the values by which facets are removed, and preliminary values of the vertices at them.
Values values_of_facets(const InnerComplex& complex, const Collapse& collapse,
                        const FacetWeights& weight, const Sheets& sheets, const Burning& burning,
                        std::span<const double> spacing, const Run& run) {
  Array<float> by_share, by_spacing;
  {
    const auto shares = in_units(burning.thickness, run, [&](int64_t) { return complex.diagonal; });
    by_share = drop_values(complex, collapse, sheets, shares, run);
  }
  {
    auto spacings = in_units(burning.thickness, run, [&](int64_t f) {
      const auto& [p, q] = complex.generators[f];
      return 0.5 * (spacing[p] + spacing[q]);
    });
    for (size_t f = 0; f < spacings.size(); ++f) {
      const bool burns = spacings[f] > 0 && spacings[f] < HUGE_VALF;
      if (burns && weight.is_certain(complex.dual[f])) spacings[f] = kCertain;
    }
    by_spacing = drop_values(complex, collapse, sheets, spacings, run);
  }
  return with_vertices(complex, joined(by_share, by_spacing, burning.erosion, run), run);
}

// Lets every facet that burns have a thickness.
void raise_to_least(double least, double diagonal, std::span<const uint8_t> gone_before,
                    Burning& burning) {
  for (size_t f = 0; f < burning.thickness.size(); ++f) {
    if (gone_before[f]) continue;
    burning.thickness[f] = std::max(burning.thickness[f], least * diagonal);
    raise(burning.erosion[f], static_cast<float>(least));
  }
}

// Gives wires the value that they had before, if it is larger. No vertex has a larger value than
// the one that had to wait for it.
void keep_limbs(std::span<const float> before, const Wires& wires, const Collapse& collapse,
                Array<float>& limb) {
  for (size_t i = 0; i < wires.order.size(); ++i) {
    const int32_t v = wires.order[i];
    const float known = before[collapse.edge_of_vertex[v]];
    if (known < HUGE_VALF) raise(limb[v], known);
    raise(limb[wires.next[i]], limb[v]);
  }
}

}  // namespace

// Where one stage keeps only one thread busy, other work runs in parallel. The arena gives its free
// memory back to the system before the stages that take most, because its gaps are too small for
// them.
void burn_down(Hierarchy::Parts& made, Collapse collapse, const Fuel& fuel,
               const std::function<void()>& beside_fire, const std::function<void()>& beside_limbs,
               const Bar& bar, Stopwatch& watch, const Run& run) {
  const Run quiet{run.threads, nullptr, run.arena}, alone{1, nullptr, run.arena};
  const InnerComplex& complex = made.complex;
  const auto together = [&](const std::function<void()>& a, const std::function<void()>& b) {
    side_by_side(std::array{a, b}, run);
  };
  begin_stage(run.progress, "Fire", bar.fire, bar.wires);
  Burning burning;
  Wires wires;
  {
    const Sheets sheets = find_sheets(complex, collapse, quiet);
    watch.lap("sheets");
    release(run.arena);
    release_heap();
    const auto gone_before = fuel.least > 0 ? kept(collapse.facet_gone) : Array<uint8_t>();
    together([&] { burning = burn(complex, fuel.radius, collapse, run); }, beside_fire);
    if (fuel.least > 0) raise_to_least(fuel.least, complex.diagonal, gone_before, burning);
    watch.lap("fire");
    begin_stage(run.progress, "Wires", bar.wires, bar.values);
    release(run.arena);
    together([&] { wires = burn_wires(complex, burning, collapse, run); },
             [&] {
               made.values = values_of_facets(complex, collapse, fuel.weight, sheets, burning,
                                              fuel.spacing, alone);
             });
    made.thickness =
        kept(in_units(burning.thickness, quiet, [&](int64_t) { return complex.diagonal; }));
    burning = {};
    watch.lap("wires");
  }
  begin_stage(run.progress, "Values", bar.values, bar.crisp);
  release(run.arena);
  together([&] { made.limb = kept(limb_values(complex, collapse, wires, alone)); },
           [&] {
             go_along(wires, complex, collapse, made.values, alone);
             beside_limbs();
           });
  if (!fuel.limb.empty()) keep_limbs(fuel.limb, wires, collapse, made.limb);
  made.partner = std::move(collapse.partner);
}

}  // namespace medial
