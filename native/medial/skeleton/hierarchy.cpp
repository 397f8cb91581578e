// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/hierarchy.h"

#include "base/heap.h"
#include "skeleton/betti.h"
#include "skeleton/bubbles.h"
#include "skeleton/fringe.h"
#include "skeleton/level.h"
#include "skeleton/limbs.h"
#include "skeleton/sheets.h"
#include "skeleton/wall_partners.h"

namespace medial {
namespace {

// How far the bar is where each stage begins. Faces and crisp places, where there are any, take
// most of the time.
struct Bar {
  double complex, fringe, fire, wires, values, crisp;
};
constexpr Bar kWithoutFaces{0, 0.2, 0.4, 0.7, 0.8, 0.85};
constexpr Bar kWithFaces{0.1, 0.14, 0.17, 0.27, 0.3, kBarOfCrispPlaces};

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

// Runs the stages 0 and 1, which leave K1.
Collapse peel(const InnerComplex& complex, const FacetWeights& weight, const Bar& bar,
              const Run& run) {
  begin_stage(run.progress, "Fringe", bar.fringe, bar.fire);
  Collapse collapse = whole(complex, weight, {run.threads, nullptr, run.arena});
  open_bubbles(complex, weight, collapse, run);
  peel_facets(complex, weight, collapse, run);
  peel_wires(complex, collapse, run);
  return collapse;
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

// Runs the stages of the collapse. Where one keeps only one thread busy, other work runs in
// parallel. The arena gives its free memory back to the system before the stages that take most,
// because its gaps are too small for them.
void collapse_all(Hierarchy::Parts& made, const Facets& facets, const FacetWeights& weight,
                  const std::function<void()>& beside_fire,
                  const std::function<void()>& beside_limbs, const Bar& bar, Stopwatch& watch,
                  const Run& run) {
  const Run quiet{run.threads, nullptr, run.arena}, alone{1, nullptr, run.arena};
  const InnerComplex& complex = made.complex;
  const auto together = [&](const std::function<void()>& a, const std::function<void()>& b) {
    side_by_side(std::array{a, b}, run);
  };
  Collapse collapse = peel(complex, weight, bar, run);
  watch.lap("fringe");
  begin_stage(run.progress, "Fire", bar.fire, bar.wires);
  Burning burning;
  Wires wires;
  {
    const Sheets sheets = find_sheets(complex, collapse, quiet);
    watch.lap("sheets");
    release(run.arena);
    release_heap();
    together([&] { burning = burn(complex, facets.points, collapse, run); }, beside_fire);
    watch.lap("fire");
    begin_stage(run.progress, "Wires", bar.wires, bar.values);
    release(run.arena);
    together([&] { wires = burn_wires(complex, burning, collapse, run); },
             [&] {
               made.values = values_of_facets(complex, collapse, weight, sheets, burning,
                                              facets.significance.spacing, alone);
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
  made.partner = std::move(collapse.partner);
}

// Keeps how strongly the facets satisfy the conditions.
void keep_significance(Hierarchy::Parts& made, const Significance& significance, Rule rule,
                       const Run& run) {
  const auto& dual = made.complex.dual;
  made.sine.resize(dual.size());
  made.rho.resize(dual.size());
  parallel_for(static_cast<int64_t>(dual.size()), run, [&](int64_t f) {
    made.sine[f] = significance.sines(rule)[dual[f]];
    made.rho[f] = significance.ratios(rule)[dual[f]];
  });
}

void bring_outward(Level& level, const Frame& frame) {
  if (frame.is_plain()) return;
  for (auto* places : {&level.vertices, &level.exact}) {
    for (Vec3& p : *places) p = frame.outward(p);
  }
  for (auto* radii : {&level.radius, &level.exact_radius}) {
    for (double& r : *radii) r = frame.outward(r);
  }
}

// The umbrellas of samples in pairs hold needles, as on the narrow side of a plate, whose
// circumcircles are far larger than the holes between the samples. No hole is larger than the ball
// that holds a few pairs.
std::vector<double> bounded_spacing(const Samples& samples, std::span<const double> spacing,
                                    const Run& run) {
  constexpr size_t kFewPairs = 10;
  std::vector<double> bounded(spacing.begin(), spacing.end());
  const auto count = static_cast<int64_t>(samples.row.size());
  const PointTree tree(std::span(samples.points.data(), samples.row.size()));
  parallel_for(
      count, run,
      [&](int64_t s) {
        bounded[s] = std::min(bounded[s], tree.reach(samples.points[s], kFewPairs));
      },
      256);
  return bounded;
}

}  // namespace

Hierarchy make_hierarchy(const Samples& samples, const Facets& facets, const Thresholds& thresholds,
                         const FacesInput* faces, std::span<const int32_t> partners, bool places,
                         const Frame& frame, const Run& run) {
  auto parts = std::make_unique<Hierarchy::Parts>();
  Hierarchy::Parts& made = *parts;
  made.threads = run.threads;
  made.frame = frame;
  Stopwatch watch(made.timings);
  const std::span<const double> spacing = facets.significance.spacing;
  std::vector<double> bounded;
  std::vector<EdgeMark> marks;
  const Bar& bar = faces && places ? kWithFaces : kWithoutFaces;
  if (faces) {
    begin_stage(run.progress, "Faces", 0, std::max(bar.complex, 0.1));
    // The faces outlive the arena.
    made.faces = std::make_unique<Faces>(*faces, frame, Run{run.threads, run.progress, nullptr});
    if (!partners.empty()) bounded = bounded_spacing(samples, spacing, run);
    made.on_faces = std::make_unique<SamplesOnFaces>(*faces, *made.faces, samples,
                                                     partners.empty() ? spacing : bounded, run);
    marks = crease_marks(*made.on_faces, facets.edges, run);
    watch.lap("faces");
  }
  if (!partners.empty()) {
    mark_partners(WallPartners(partners, samples, run), facets.edges, marks, run);
  }
  const FacetWeights weight(facets, thresholds, marks);
  begin_stage(run.progress, "Inner complex", bar.complex, bar.fringe);
  made.complex =
      inner_complex(samples, facets.triangulation, facets.voronoi, facets.edges, facets.sides, run);
  watch.lap("complex");
  const auto beside_fire = [&, alone = Run{1, nullptr, run.arena}] {
    made.outside = outside_components(made.complex, samples.count(), facets.triangulation,
                                      facets.edges, alone);
    made.betti = betti_of(made.complex, made.outside, alone);
  };
  const auto beside_limbs = [&] {
    made.samples = PointTree(std::span(samples.points.data(), samples.row.size()));
    made.row = samples.row;
    made.spacing.assign(spacing.begin(), spacing.end());
    if (!bounded.empty()) made.spacing = bounded;
  };
  collapse_all(made, facets, weight, beside_fire, beside_limbs, bar, watch, run);
  release(run.arena);
  keep_significance(made, facets.significance, thresholds.rule, {run.threads, nullptr, run.arena});
  if (made.on_faces) {
    made.on_crease = vertices_on_creases(made.complex, facets.triangulation, *made.on_faces,
                                         made.values.facet, {run.threads, nullptr, run.arena});
  }
  if (made.on_faces && places) {
    std::vector<uint8_t> selected;
    for (const ShrunkFacet& s : made.complex.shrunk) selected.push_back(weight.selected(s.dual));
    made.crisp = crisp_places(made.complex, facets.triangulation, *made.on_faces, made.values.facet,
                              made.sine, selected, run);
    watch.lap("crisp");
  } else {
    begin_stage(run.progress, "Values", bar.crisp, 1);
  }
  made.complex.dual = {};  // these indices mean nothing without the analysis
  watch.lap("values");
  advance(run.progress, 1);
  return Hierarchy(std::move(parts));
}

Hierarchy::Hierarchy(std::unique_ptr<const Parts> parts) : parts_(std::move(parts)) {}
Hierarchy::~Hierarchy() = default;
Hierarchy::Hierarchy(Hierarchy&&) noexcept = default;
Hierarchy& Hierarchy::operator=(Hierarchy&&) noexcept = default;

const Betti& Hierarchy::betti() const { return parts_->betti; }
double Hierarchy::diagonal() const { return parts_->frame.outward(parts_->complex.diagonal); }
size_t Hierarchy::bytes() const {
  const auto size_of = [](const auto&... arrays) {
    return (... + (arrays.size() * sizeof(arrays[0])));
  };
  const Parts& p = *parts_;
  const InnerComplex& c = p.complex;
  return size_of(c.cell, c.position, c.radius, c.ends, c.generators, c.offsets, c.corners, c.shrunk,
                 c.bubbles, p.partner, p.thickness, p.values.facet, p.values.vertex, p.limb, p.row,
                 p.outside, p.sine, p.rho, p.crisp.position, p.crisp.radius, p.crisp.place,
                 p.on_crease) +
         (c.dual.size() + c.cell.size()) * sizeof(float) +  // of `spikes`, known or not
         p.samples.bytes() + p.spacing.size() * sizeof(double) +
         (p.faces ? p.faces->bytes() + p.on_faces->bytes() : 0);
}
const Timings& Hierarchy::timings() const { return parts_->timings; }

Level Hierarchy::extract(const LevelOptions& options, Progress* progress) const {
  Level found = level(*parts_, options, {parts_->threads, progress});
  bring_outward(found, parts_->frame);
  return found;
}

}  // namespace medial
