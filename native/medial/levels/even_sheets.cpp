// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/even_sheets.h"

#include "base/rows.h"
#include "exact/even_creases.h"
#include "exact/even_places.h"
#include "exact/simplices.h"
#include "levels/even_level.h"
#include "remesh/remesh.h"
#include "remesh/target_length.h"

namespace medial {
namespace {

// Lengths are in holes between the samples, the largest circumradii of their umbrellas. Samples of
// blue noise are about 1.65 holes apart.
constexpr double kEdge = 2.8;       // the edge wanted: 1.7 distances of samples; chosen: axis
constexpr double kLeastEdge = 1.3;  // in narrow sheets: nothing to gain below; chosen: axis
// where a sheet is curved: half the distance of samples, below which they know no curvature
constexpr double kLeastOfCurved = 0.8;  // derived: 0.5 / 0.6
constexpr double kMerged = 0.3;  // that Voronoi vertices of one place are apart; chosen: axis
constexpr double kOfArea = 2.5;  // the same in sides of a facet, for rough scans; chosen: axis
// the same in half-widths of the sheet, so that lengths grow by it along narrow sheets, and nowhere
// by more
constexpr double kOfWidth = 0.5;  // chosen: axis
constexpr int kMovingRounds = 2;  // in which curves lose the zigzag of the samples
constexpr int kRounds = 6, kRoundsAfterPlaces = 2, kSlides = 6;

class EvenSheets {
 public:
  EvenSheets(Level& level, const Hierarchy::Parts& h, bool crisp, const Run& run)
      : level_(level),
        h_(h),
        samples_(crisp ? h.on_faces.get() : nullptr),
        run_{run.threads, nullptr, nullptr},
        progress_(run.progress) {}

  EvenVertices make() {
    generators_ = rows_of(h_.complex.generators, level_.facet_of);
    EvenMesh even = start();
    std::optional<EvenCreases> creases;
    if (samples_) creases.emplace(even, *samples_, generators_, hole_, radius_, run_).hold();
    std::vector<double> within(hole_);
    for (double& w : within) w *= kMerged;
    merge_close(even, within);
    leave_out_what_is_gone(even);
    choose_targets(even);
    RemeshOptions options{true, kChordOfLine * h_.complex.diagonal, onto_creases(samples_)};
    for (int round = 0; round < kRounds; ++round) {
      options.moves_curves = round < kMovingRounds;
      one_round(even, options, 0.4 * round / kRounds);
      if (round == 0) leave_out_what_is_gone(even);
      if (creases) creases->hold();
      if (creases && round > 0) creases->fill_notches();
    }
    if (!samples_) return write_even(even, {}, {}, h_, level_, run_);
    EvenPlaces places(even, *samples_, generators_, level_.wires, run_);
    settle(even, places, options);
    return write_even(even, places.placing(), places.radius(), h_, level_, run_);
  }

 private:
  void one_round(EvenMesh& even, const RemeshOptions& options, double share) {
    advance(progress_, share);
    throw_if_cancelled(progress_);
    remesh(even, options, run_);
    unite_held(even);
  }

  // Merging leaves a third of the mesh, and the first round a tenth of that; what follows is
  // quicker without the rest.
  void leave_out_what_is_gone(EvenMesh& even) {
    const std::vector<int32_t> number = compact(even);
    for (auto& [a, b] : level_.wires) a = number[a], b = number[b];
    for (int32_t& v : level_.points) v = number[v];
  }

  EvenMesh start() {
    Simplices simplices = simplices_of(level_, run_);
    std::vector<int32_t> origin = all_rows(level_.vertices.size());
    std::vector<Vec3> position(level_.vertices.begin(), level_.vertices.end());
    radius_.assign(level_.radius.begin(), level_.radius.end());
    for (const int32_t f : simplices.centres) {
      const auto begin = level_.face_offsets[f], end = level_.face_offsets[f + 1];
      Vec3 sum;
      for (int32_t c = begin; c < end; ++c) sum = sum + position[level_.face_vertices[c]];
      position.push_back((1.0 / (end - begin)) * sum);
      origin.push_back(level_.face_vertices[begin]);
      radius_.push_back(radius_[origin.back()]);
    }
    EvenMesh even = mesh_of(std::move(simplices), std::move(position), std::move(origin));
    find_holes(even);
    return even;
  }

  EvenMesh mesh_of(Simplices simplices, std::vector<Vec3> position,
                   std::vector<int32_t> origin) const {
    std::vector<Vec3> normal;
    for (const int32_t f : simplices.source) {
      const auto& [p, q] = generators_[f];
      normal.push_back(normalized((*h_.samples)[q] - (*h_.samples)[p]));
    }
    const size_t count = position.size();
    std::vector<uint8_t> is_node(count, 0);
    for (const int32_t v : level_.points) is_node[v] = 1;
    SheetComplex mesh(static_cast<int32_t>(count), std::move(simplices.triangles), level_.wires,
                      is_node);
    return {std::move(mesh),
            std::move(position),
            std::vector<double>(count),
            std::move(origin),
            std::vector<uint8_t>(count, kFree),
            std::move(simplices.source),
            std::move(normal)};
  }

  // Finds the largest hole between the samples at each vertex, and the mean area of its facets.
  void find_holes(const EvenMesh& even) {
    std::vector<double> area(generators_.size(), 0);
    for (int32_t t = 0; t < even.mesh.triangles(); ++t) {
      const auto& [a, b, c] = even.mesh.triangle(t);
      area[even.source[t]] += 0.5 * length(cross(even.position[b] - even.position[a],
                                                 even.position[c] - even.position[a]));
    }
    hole_.assign(even.position.size(), 0);
    facet_area_.assign(even.position.size(), 0);
    parallel_for(even.mesh.vertices(), run_, [&](int64_t v) {
      int count = 0;
      double sum = 0;
      even.mesh.for_triangles(static_cast<int32_t>(v), [&](int32_t t) {
        const int32_t f = even.source[t];
        for (const int32_t s : generators_[f]) hole_[v] = std::max(hole_[v], (*h_.spacing)[s]);
        sum += area[f];
        ++count;
      });
      facet_area_[v] = count > 0 ? sum / count : 0;
    });
  }

  void choose_targets(EvenMesh& even) {
    const auto width = half_widths(even.mesh, even.position);
    parallel_for(even.mesh.vertices(), run_, [&](int64_t v) {
      const double hole = hole_[even.origin[v]], side = std::sqrt(facet_area_[even.origin[v]]);
      const double least = std::max(kLeastEdge * hole, 0.4 * kOfArea * side);
      const double most = std::max(kEdge * hole, kOfArea * side);
      even.target[v] = std::clamp(kOfWidth * width[v], least, most);
    });
    spread_least(even.mesh, even.position, kOfWidth, even.target);
  }

  void settle(EvenMesh& even, EvenPlaces& places, RemeshOptions& options) {
    for (int round = 0; round < kRoundsAfterPlaces; ++round) {
      places.place();
      follow_curvature(even);
      one_round(even, options, 0.4 + 0.1 * round);
    }
    places.place();
    // Rims lose what is uneven in their steps, and what that took off them comes back.
    options.moves_curves = true;
    for (int i = 0; i < kSlides && places.slide(); ++i) {
      one_round(even, options, 0.6 + 0.3 * i / kSlides);
      places.place_rims();
    }
    places.finish();
  }

  // The chord of a curved line misses it by an eighth of its curvature times the squared length.
  // The longest edge that is not split may miss the sheet so.
  void follow_curvature(EvenMesh& even) {
    const std::vector<double> curvature = curvatures(even, run_);
    const double chord = kChord * h_.complex.diagonal;
    for (int32_t v = 0; v < even.mesh.vertices(); ++v) {
      if (!(curvature[v] > 0)) continue;
      const double least = kLeastOfCurved * hole_[even.origin[v]];
      const double wanted = std::sqrt(8 * chord / curvature[v]) / kLong;
      even.target[v] = std::min(even.target[v], std::max(least, wanted));
    }
    spread_least(even.mesh, even.position, kOfWidth, even.target);
  }

  Level& level_;
  const Hierarchy::Parts& h_;
  const SamplesOnFaces* samples_;  // null if no faces give places
  Run run_;
  Progress* progress_;
  Array<Edge> generators_;                          // per facet of the level: samples
  std::vector<double> hole_, radius_, facet_area_;  // per vertex at the start
};

}  // namespace

EvenVertices make_even(Level& level, const Hierarchy::Parts& hierarchy, bool crisp,
                       const Run& run) {
  if (level.facet_of.empty()) return {};
  return EvenSheets(level, hierarchy, crisp, run).make();
}

}  // namespace medial
