// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/level.h"

#include "axis/significance.h"
#include "base/sort.h"
#include "skeleton/betti.h"
#include "skeleton/relax.h"
#include "skeleton/round_limbs.h"

namespace medial {
namespace {

void check(double threshold, const char* name) {
  if (!(threshold >= 0)) {
    throw InvalidInputError("Expected a threshold " + std::string(name) + " of 0 or more, found " +
                            std::to_string(threshold) + "; 0 keeps all that MEDIAL selects.");
  }
}

bool exceeds(float value, double threshold) { return value > threshold || value == HUGE_VALF; }

Alive alive_at(const Hierarchy::Parts& h, const LevelOptions& t, const Run& run) {
  const InnerComplex& complex = h.complex;
  Alive alive{array<uint8_t>(complex.generators.size(), run),
              array<uint8_t>(complex.ends.size(), run), array<uint8_t>(complex.cell.size(), run)};
  parallel_for(complex.facets(), run,
               [&](int64_t f) { alive.facet[f] = exceeds(h.values.facet[f], t); });
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    alive.vertex[v] = exceeds(h.values.vertex[v], t) || h.limb[v] > t.limb;
  });
  parallel_for(complex.edges(), run, [&](int64_t e) {
    const int32_t partner = h.partner[e];
    alive.edge[e] = partner == kAlone ||
                    (partner >= 0 ? alive.facet[partner] : alive.vertex[with_vertex(partner)]);
  });
  return alive;
}

// Puts what is there into a mesh.
class Drawer {
 public:
  Drawer(const Hierarchy::Parts& h, const Alive& alive, const Run& run)
      : h_(h),
        complex_(h.complex),
        alive_(alive),
        run_(run),
        used_(array<uint8_t>(h.complex.ends.size(), 0, run)),
        touched_(array<uint8_t>(h.complex.cell.size(), 0, run)),
        number_(array<int32_t>(h.complex.cell.size(), -1, run)) {}

  Level draw() {
    draw_facets();
    draw_wires();
    draw_points();
    place_vertices();
    read_values();
    return std::move(level_);
  }

  // Edges with exactly one facet, after it.
  std::vector<Edge> rims() const {
    return parallel_append<Edge>(complex_.edges(), run_, [&](int64_t e, auto& out, int) {
      const auto& [a, b] = complex_.ends[e];
      if (used_[e] == 1) out.push_back({number_[a], number_[b]});
    });
  }

 private:
  bool is_loop(int32_t edge) const { return complex_.ends[edge][0] == complex_.ends[edge][1]; }

  int32_t number(int32_t vertex) {
    if (number_[vertex] < 0) {
      number_[vertex] = static_cast<int32_t>(level_.vertex_of.size());
      level_.vertex_of.push_back(vertex);
    }
    return number_[vertex];
  }

  // In the order of their generators.
  std::vector<int32_t> facets_in_order() const {
    const auto found =
        parallel_append<int32_t>(complex_.facets(), run_, [&](int64_t f, auto& out, int) {
          if (alive_.facet[f]) out.push_back(static_cast<int32_t>(f));
        });
    int32_t rows = 0;
    for (const int32_t row : h_.row) rows = std::max(rows, row + 1);
    const auto row = [&](int64_t i, int end) { return h_.row[complex_.generators[found[i]][end]]; };
    const auto order = bucket_order(
        static_cast<int64_t>(found.size()), static_cast<size_t>(rows), run_,
        [&](int64_t i) { return row(i, 0); }, [&](int64_t i) { return row(i, 1); });
    std::vector<int32_t> facets;
    facets.reserve(found.size());
    for (const int32_t i : order) facets.push_back(found[i]);
    return facets;
  }

  void draw_facets() {
    const auto facets = facets_in_order();
    size_t corners = 0;
    for (const int32_t f : facets) corners += complex_.ring(f).size();
    level_.face_vertices.reserve(corners);
    level_.face_offsets.reserve(facets.size() + 1);
    level_.generators.reserve(facets.size());
    level_.facet_of.reserve(facets.size());
    level_.vertex_of.reserve(
        static_cast<size_t>(std::count(alive_.vertex.begin(), alive_.vertex.end(), uint8_t{1})));
    level_.face_offsets.push_back(0);
    std::vector<int32_t> polygon, edges;
    for (const int32_t f : facets) {
      polygon.clear();
      edges.clear();
      for (const auto& [vertex, edge] : complex_.ring(f)) {
        if (is_loop(edge)) continue;
        polygon.push_back(vertex);
        edges.push_back(edge);
      }
      if (polygon.size() < 3) {
        ++level_.hidden;
        continue;
      }
      for (int32_t& vertex : polygon) vertex = number(vertex);
      std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
      if (is_twin(polygon)) {
        ++level_.hidden;
        continue;
      }
      for (const int32_t edge : edges) used_[edge] += used_[edge] < 2;
      const auto& [p, q] = complex_.generators[f];
      level_.face_vertices.insert(level_.face_vertices.end(), polygon.begin(), polygon.end());
      level_.face_offsets.push_back(static_cast<int32_t>(level_.face_vertices.size()));
      level_.generators.push_back({h_.row[p], h_.row[q]});
      level_.facet_of.push_back(f);
    }
  }

  // Whether an earlier facet has the same corners; notes the polygon where none has. In any order:
  // two facets between parallel edges are one to the eye.
  bool is_twin(const std::vector<int32_t>& polygon) {
    newest_.resize(level_.vertex_of.size(), -1);
    for (int32_t f = newest_[polygon[0]]; f >= 0; f = before_[f]) {
      const auto first = level_.face_vertices.begin() + level_.face_offsets[f];
      const auto last = level_.face_vertices.begin() + level_.face_offsets[f + 1];
      if (std::is_permutation(first, last, polygon.begin(), polygon.end())) return true;
    }
    before_.push_back(newest_[polygon[0]]);
    newest_[polygon[0]] = static_cast<int32_t>(before_.size()) - 1;
    return false;
  }

  void draw_wires() {
    for (int32_t e = 0; e < complex_.edges(); ++e) {
      if (!alive_.edge[e]) continue;
      if (is_loop(e)) {
        ++level_.hidden;
        continue;
      }
      const auto& [a, b] = complex_.ends[e];
      touched_[a] = touched_[b] = 1;
      if (used_[e]) continue;
      level_.wires.push_back({number(a), number(b)});
      level_.edge_of.push_back(e);
    }
  }

  void draw_points() {
    for (int32_t v = 0; v < complex_.vertices(); ++v) {
      if (alive_.vertex[v] && !touched_[v]) level_.points.push_back(number(v));
    }
  }

  void place_vertices() {
    level_.vertices.resize(level_.vertex_of.size());
    level_.radius.resize(level_.vertex_of.size());
    parallel_for(static_cast<int64_t>(level_.vertex_of.size()), run_, [&](int64_t v) {
      level_.vertices[v] = complex_.position[level_.vertex_of[v]];
      level_.radius[v] = complex_.radius[level_.vertex_of[v]];
    });
    level_.exact = level_.vertices;
    level_.exact_radius = level_.radius;
  }

  void read_values() {
    const size_t facets = level_.facet_of.size(), wires = level_.edge_of.size();
    level_.sheet.resize(facets);
    level_.erosion.resize(facets);
    level_.limb.resize(wires);
    level_.theta.resize(facets);
    level_.rho.resize(facets);
    parallel_for(static_cast<int64_t>(facets), run_, [&](int64_t f) {
      level_.theta[f] = theta_of(h_.sine[level_.facet_of[f]]);
      level_.rho[f] = h_.rho[level_.facet_of[f]];
    });
    for (size_t f = 0; f < facets; ++f) {
      const Thickness& value = h_.values.facet[level_.facet_of[f]];
      level_.sheet[f] = value.sheet;
      level_.erosion[f] = value.erosion;
    }
    for (size_t w = 0; w < wires; ++w) level_.limb[w] = h_.limb_of_edge(level_.edge_of[w]);
  }

  const Hierarchy::Parts& h_;
  const InnerComplex& complex_;
  const Alive& alive_;
  Run run_;
  Array<uint8_t> used_;     // per edge: by no facet, one, or more
  Array<uint8_t> touched_;  // per vertex: by an edge
  Array<int32_t> number_;   // per vertex: in the level
  // Per vertex of the level the newest facet that starts there, per facet the one before it; or -1.
  std::vector<int32_t> newest_, before_;
  Level level_;
};

}  // namespace

bool exceeds(const Thickness& value, const LevelOptions& t) {
  return exceeds(value.sheet, t.sheet) && exceeds(value.spacings, t.spacings) &&
         exceeds(value.erosion, t.erosion);
}

Level level(const Hierarchy::Parts& h, const LevelOptions& options, const Run& run) {
  check(options.sheet, "sheet");
  check(options.spacings, "spacings");
  check(options.erosion, "erosion");
  check(options.limb, "limb");
  begin_stage(run.progress, "Limbs", 0, 0.3);
  const Run quiet{run.threads, nullptr, run.arena};
  Alive alive = alive_at(h, options, quiet);
  if (options.round_limbs) shed_flat_limbs(h, options, alive, run);
  begin_stage(run.progress, "Level", 0.3, options.relaxed ? 0.6 : 1);
  throw_if_cancelled(run.progress);
  Drawer drawer(h, alive, quiet);
  Level level = drawer.draw();
  throw_if_cancelled(run.progress);
  level.betti = betti_of(h.complex, h.outside, alive, quiet);
  if (options.relaxed) relax(level, drawer.rims(), h, run);
  advance(run.progress, 1);
  return level;
}

}  // namespace medial
