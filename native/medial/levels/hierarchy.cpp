// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/hierarchy.h"

#include "collapse/bubbles.h"
#include "collapse/fringe.h"
#include "levels/burn_down.h"
#include "levels/even_hierarchy.h"
#include "walls/wall_partners.h"

namespace medial {
namespace {

constexpr Bar kWithoutFaces{0, 0.2, 0.4, 0.7, 0.8, 0.85};
constexpr Bar kWithFaces{0.1, 0.14, 0.17, 0.27, 0.3, kBarOfCrispPlaces};

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

// Keeps how strongly the facets satisfy the conditions.
void keep_significance(Hierarchy::Parts& made, const Significance& significance,
                       const Thresholds& thresholds, const FacetWeights& weight, const Run& run) {
  const auto& dual = made.complex.dual;
  made.thresholds = thresholds;
  made.chosen.resize(dual.size());
  made.sine.resize(dual.size());
  made.rho.resize(dual.size());
  parallel_for(static_cast<int64_t>(dual.size()), run, [&](int64_t f) {
    made.sine[f] = significance.sines(thresholds.rule)[dual[f]];
    made.rho[f] = significance.ratios(thresholds.rule)[dual[f]];
    const bool is_certain = weight.is_certain(dual[f]);
    made.chosen[f] = is_certain                 ? Chosen::by_faces
                     : weight.selected(dual[f]) ? Chosen::by_thresholds
                                                : Chosen::no;
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
    made.faces = std::make_shared<Faces>(*faces, frame, Run{run.threads, run.progress, nullptr});
    if (!partners.empty()) bounded = bounded_spacing(samples, spacing, run);
    made.on_faces = std::make_shared<SamplesOnFaces>(*faces, *made.faces, samples,
                                                     partners.empty() ? spacing : bounded, run);
    marks = crease_marks(*made.on_faces, facets.edges, run);
    watch.lap("faces");
  }
  if (!partners.empty()) {
    mark_partners(WallPartners(partners, samples, run), facets.edges, marks, run);
  }
  const EdgeWeights weight(facets, thresholds, marks);
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
    made.samples = std::make_shared<PointTree>(
        std::span<const Vec3>(samples.points.data(), samples.row.size()));
    made.row = std::make_shared<std::vector<int32_t>>(samples.row);
    if (bounded.empty()) bounded.assign(spacing.begin(), spacing.end());
    made.spacing = std::make_shared<std::vector<double>>(bounded);
  };
  Collapse collapse = peel(made.complex, weight, bar, run);
  watch.lap("fringe");
  const RadiusInFacet radius = radius_by(made.complex, facets.points);
  burn_down(made, std::move(collapse), {weight, radius, facets.significance.spacing}, beside_fire,
            beside_limbs, bar, watch, run);
  if (run.arena) run.arena->release();
  keep_significance(made, facets.significance, thresholds, weight,
                    {run.threads, nullptr, run.arena});
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

Hierarchy::Hierarchy(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
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
  const size_t own =
      size_of(c.cell, c.position, c.radius, c.ends, c.generators, c.offsets, c.corners, c.shrunk,
              c.bubbles, p.partner, p.thickness, p.values.facet, p.values.vertex, p.limb, p.outside,
              p.sine, p.rho, p.chosen, p.crisp.position, p.crisp.radius, p.crisp.place,
              p.on_crease) +
      (c.dual.size() + c.cell.size()) * sizeof(float);  // of `spikes`, known or not
  if (p.even) {  // the samples and faces are those of the hierarchy that it was made of
    const EvenBase& e = *p.even;
    return own + size_of(e.vertices.target, e.vertices.held, e.vertices.is_end, e.exact,
                         e.exact_radius, e.limb);
  }
  return own + size_of(*p.row, *p.spacing) + p.samples->bytes() +
         (p.faces ? p.faces->bytes() + p.on_faces->bytes() : 0);
}
const Timings& Hierarchy::timings() const { return parts_->timings; }

Hierarchy Hierarchy::even(const EvenOptions& options, Progress* progress) const {
  return Hierarchy(even_parts(*parts_, options, {parts_->threads, progress}));
}

Hierarchy Hierarchy::selecting(double theta, double rho, Progress* progress) const {
  return Hierarchy(parts_selecting(*parts_, theta, rho, {parts_->threads, progress}));
}

Level Hierarchy::extract(const LevelOptions& options, Progress* progress) const {
  Level found = level(*parts_, options, {parts_->threads, progress});
  bring_outward(found, parts_->frame);
  return found;
}

}  // namespace medial
