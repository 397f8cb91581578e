// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/even_hierarchy.h"

#include <numeric>

#include "base/rows.h"
#include "base/sort_unique.h"
#include "collapse/fringe.h"
#include "levels/burn_down.h"
#include "levels/even_sheets.h"

namespace medial {
namespace {

using Parts = Hierarchy::Parts;

constexpr Bar kBar{0, 0.1, 0.2, 0.5, 0.6, 1};
// The thickness, as a share of the diagonal, that every triangle has, so that the levels without
// thresholds are the whole mesh.
constexpr double kLeastThickness = 1e-30;  // derived: above 0, below every thickness

// The mesh was chosen by the thresholds and the thickness in spacings, so no triangle is to be
// doubted by its spacings again. With higher thresholds it may be selected no more.
class TriangleWeights : public FacetWeights {
 public:
  TriangleWeights(const Parts& of, const Thresholds& thresholds)
      : of_(of), t_(thresholds), sine_(largest_sine(thresholds.theta)) {}

  bool selected(int32_t t) const override {
    if (of_.chosen[t] != Chosen::by_thresholds) return of_.chosen[t] == Chosen::by_faces;
    return (t_.criteria != Criteria::ratio && of_.sine[t] > sine_) ||
           (t_.criteria != Criteria::angle && of_.rho[t] > t_.rho);
  }
  bool is_certain(int32_t) const override { return true; }
  double operator()(int32_t t) const override {
    return share_of_thresholds(of_.sine[t], of_.rho[t], t_);
  }

 private:
  const Parts& of_;
  Thresholds t_;
  double sine_;  // the largest that fails the Angle condition
};

std::vector<Edge> edges_of(const Level& level) {
  std::vector<Edge> edges(level.wires.begin(), level.wires.end());
  for (size_t c = 0; c + 2 < level.face_vertices.size(); c += 3) {
    const int32_t* corner = level.face_vertices.data() + c;
    for (int i = 0; i < 3; ++i) edges.push_back({corner[i], corner[(i + 1) % 3]});
  }
  for (auto& [a, b] : edges) {
    if (a > b) std::swap(a, b);
  }
  sort_unique(edges);
  return edges;
}

int32_t edge_between(std::span<const Edge> edges, int32_t a, int32_t b) {
  const Edge wanted{std::min(a, b), std::max(a, b)};
  return static_cast<int32_t>(std::lower_bound(edges.begin(), edges.end(), wanted) - edges.begin());
}

// Returns the complex of a level whose facets are triangles; of the level's ids, those of vertices
// and facets are its own.
InnerComplex complex_of(const Level& level, const InnerComplex& of) {
  InnerComplex complex;
  complex.cell = rows_of(of.cell, level.vertex_of);
  complex.position.assign(level.vertices.begin(), level.vertices.end());
  complex.radius.assign(level.radius.begin(), level.radius.end());
  const std::vector<Edge> edges = edges_of(level);
  complex.ends.assign(edges.begin(), edges.end());
  complex.generators = rows_of(of.generators, level.facet_of);
  complex.dual.resize(level.facet_of.size());
  std::iota(complex.dual.begin(), complex.dual.end(), 0);
  complex.offsets.assign(level.face_offsets.begin(), level.face_offsets.end());
  for (size_t c = 0; c < level.face_vertices.size(); ++c) {
    const size_t next = c % 3 == 2 ? c - 2 : c + 1;
    const int32_t a = level.face_vertices[c], b = level.face_vertices[next];
    complex.corners.push_back({a, edge_between(edges, a, b)});
  }
  complex.diagonal = of.diagonal;
  return complex;
}

std::shared_ptr<const EvenBase> base_of(const Level& level, EvenVertices vertices,
                                        const InnerComplex& complex) {
  auto base = std::make_shared<EvenBase>();
  base->vertices = std::move(vertices);
  base->exact.assign(level.exact.begin(), level.exact.end());
  base->exact_radius.assign(level.exact_radius.begin(), level.exact_radius.end());
  base->limb.resize(complex.ends.size(), 0);
  for (size_t w = 0; w < level.wires.size(); ++w) {
    base->limb[edge_between(complex.ends, level.wires[w][0], level.wires[w][1])] = level.limb[w];
  }
  return base;
}

// Returns the radius at a place in a triangle: the mean of the radii at its corners.
RadiusInFacet mean_radius(const InnerComplex& complex) {
  return [&complex](int32_t facet, const Vec3&) {
    double sum = 0;
    for (const Corner& c : complex.ring(facet)) sum += complex.radius[c.vertex];
    return sum / static_cast<double>(complex.ring(facet).size());
  };
}

// Burns what is left of the complex, and so completes the parts.
void burn_mesh(Parts& made, Collapse collapse, const FacetWeights& weight, const Run& run) {
  Stopwatch watch(made.timings);
  const RadiusInFacet radius = mean_radius(made.complex);
  const auto nothing = [] {};
  burn_down(made, std::move(collapse),
            {weight, radius, *made.spacing, kLeastThickness, made.even->limb}, nothing, nothing,
            kBar, watch, run);
  advance(run.progress, 1);
}

// Takes over what hierarchies of the same samples have in common.
void share_samples(const Parts& of, Parts& made) {
  made.frame = of.frame;
  made.threads = of.threads;
  made.thresholds = of.thresholds;
  made.faces = of.faces;
  made.on_faces = of.on_faces;
  made.samples = of.samples;
  made.row = of.row;
  made.spacing = of.spacing;
}

void keep_values(const Parts& of, const Level& level, Parts& made) {
  made.sine = rows_of(of.sine, level.facet_of);
  made.rho = rows_of(of.rho, level.facet_of);
  made.chosen = rows_of(of.chosen, level.facet_of);
  made.crisp = {
      made.complex.position, made.complex.radius, {level.place.begin(), level.place.end()}};
  for (const Placing place : level.place) made.on_crease.push_back(place >= Placing::crease);
}

}  // namespace

std::shared_ptr<const Parts> even_parts(const Parts& of, const EvenOptions& options,
                                        const Run& run) {
  if (of.even) {
    throw InvalidInputError(
        "Expected a hierarchy of the Voronoi diagram, found one of an even mesh; call `even` "
        "once.");
  }
  Level level = medial::level(
      of, {.spacings = options.spacings, .limb = options.limb, .round_limbs = options.round_limbs},
      run);
  EvenVertices vertices = make_even(level, of, options.crisp, run);
  auto parts = std::make_shared<Parts>();
  Parts& made = *parts;
  share_samples(of, made);
  if (!options.crisp) made.on_faces = nullptr;
  made.betti = level.betti;
  made.complex = complex_of(level, of.complex);
  made.even = base_of(level, std::move(vertices), made.complex);
  keep_values(of, level, made);
  const TriangleWeights weight(made, made.thresholds);
  burn_mesh(made, whole(made.complex, weight, run), weight, run);
  return parts;
}

std::shared_ptr<const Parts> parts_selecting(const Parts& of, double theta, double rho,
                                             const Run& run) {
  if (!of.even) {
    throw InvalidInputError(
        "Expected a hierarchy of an even mesh, found one of the Voronoi diagram; call `even` "
        "first, or make another hierarchy.");
  }
  auto parts = std::make_shared<Parts>();
  Parts& made = *parts;
  share_samples(of, made);
  made.thresholds.theta = theta;
  made.thresholds.rho = rho;
  require_in_range(made.thresholds);
  made.even = of.even;
  made.betti = of.betti;
  made.complex = of.complex;
  made.sine = of.sine;
  made.rho = of.rho;
  made.chosen = of.chosen;
  made.crisp = of.crisp;
  made.on_crease = of.on_crease;
  const TriangleWeights weight(made, made.thresholds);
  Collapse collapse = whole(made.complex, weight, run);
  peel_facets(made.complex, weight, collapse, run);
  // Wires of the mesh are limbs, and no remains of facets.
  collapse.selected.assign(made.even->limb.size(), 0);
  for (size_t e = 0; e < made.even->limb.size(); ++e) {
    collapse.selected[e] = made.even->limb[e] > 0;
  }
  peel_wires(made.complex, collapse, run);
  burn_mesh(made, std::move(collapse), weight, run);
  return parts;
}

}  // namespace medial
