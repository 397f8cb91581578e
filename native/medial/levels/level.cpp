// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/level.h"

#include "axis/significance.h"
#include "base/atomic.h"
#include "base/rows.h"
#include "base/sort.h"
#include "collapse/betti.h"
#include "levels/even_rims.h"
#include "levels/relax.h"
#include "levels/round_limbs.h"

namespace medial {
namespace {

void check(double threshold, const char* name) {
  if (!(threshold >= 0)) {
    throw InvalidInputError("Expected a threshold " + std::string(name) + " of 0 or more, found " +
                            std::to_string(threshold) + "; 0 keeps all that MEDIAL selects.");
  }
}

bool exceeds(float value, double threshold) { return value > threshold || value == HUGE_VALF; }

// Makes a mesh of the cells that are left.
class Drawer {
 public:
  Drawer(const Hierarchy::Parts& h, const Alive& alive, bool crisp, const Run& run)
      : h_(h),
        crisp_(crisp),
        complex_(h.complex),
        alive_(alive),
        run_(run),
        used_(array<uint8_t>(h.complex.ends.size(), 0, run)),
        touched_(array<uint8_t>(h.complex.cell.size(), 0, run)),
        number_(array<int32_t>(h.complex.cell.size(), -1, run)) {
    // Only cospherical samples cause loops, and checking the ends of edges is slow, so it is
    // checked once whether there are any.
    parallel_for(complex_.edges(), run_, [&](int64_t e) {
      if (is_loop(static_cast<int32_t>(e))) shared_store(has_loops_, uint8_t{1});
    });
  }

  Level draw() {
    draw_facets();
    draw_wires();
    draw_points();
    place_vertices();
    read_values();
    return std::move(level_);
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

  // Calls found(vertex, edge) for the edges of a facet that are not loops. A facet is drawn if it
  // has three of them.
  template <typename Found>
  void for_drawn_edges(int32_t facet, const Found& found) const {
    for (const auto& [vertex, edge] : complex_.ring(facet)) {
      if (!has_loops_ || !is_loop(edge)) found(vertex, edge);
    }
  }
  int32_t drawn_corners(int32_t facet) const {
    if (!has_loops_) return static_cast<int32_t>(complex_.ring(facet).size());
    int32_t count = 0;
    for_drawn_edges(facet, [&](int32_t, int32_t) { ++count; });
    return count;
  }

  // Returns the facets that can be drawn, in the order of their generators.
  Array<int32_t> facets_in_order() const {
    const auto found =
        parallel_append<int32_t>(complex_.facets(), run_, [&](int64_t id, auto& out, int) {
          const auto f = static_cast<int32_t>(id);
          if (alive_.facet[f] && drawn_corners(f) >= 3) out.push_back(f);
        });
    int32_t rows = 0;
    for (const int32_t row : *h_.row) rows = std::max(rows, row + 1);
    const auto row = [&](int64_t i, int end) {
      return (*h_.row)[complex_.generators[found[i]][end]];
    };
    auto facets = array<int32_t>(found.size(), run_);
    bucket_sort(
        static_cast<int64_t>(found.size()), static_cast<size_t>(rows), run_,
        [&](int64_t i) { return row(i, 0); }, [&](int64_t i) { return row(i, 1); },
        [&](int32_t position, int32_t i) { facets[position] = found[i]; });
    return facets;
  }

  void draw_facets() {
    Array<int32_t> facets = facets_in_order();
    set_corners(facets);
    number_corners();
    parallel_for(static_cast<int64_t>(facets.size()), run_, [&](int64_t i) {
      const auto polygon = corners(i);
      std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    });
    leave_twins_out(facets);
    level_.hidden = std::count(alive_.facet.begin(), alive_.facet.end(), uint8_t{1}) -
                    static_cast<int64_t>(facets.size());
    level_.generators.resize(facets.size());
    level_.facet_of.resize(facets.size());
    parallel_for(static_cast<int64_t>(facets.size()), run_, [&](int64_t i) {
      const auto& [p, q] = complex_.generators[facets[i]];
      level_.generators[i] = {(*h_.row)[p], (*h_.row)[q]};
      level_.facet_of[i] = facets[i];
      for_drawn_edges(facets[i],
                      [&](int32_t, int32_t edge) { shared_store(used_[edge], uint8_t{1}); });
    });
  }

  std::span<int32_t> corners(int64_t facet) {
    return {level_.face_vertices.data() + level_.face_offsets[facet],
            static_cast<size_t>(level_.face_offsets[facet + 1] - level_.face_offsets[facet])};
  }

  // Sets the corners to vertices of the complex.
  void set_corners(std::span<const int32_t> facets) {
    const auto count = static_cast<int64_t>(facets.size());
    level_.face_offsets.resize(facets.size() + 1);
    level_.face_offsets.back() = 0;
    parallel_for(count, run_,
                 [&](int64_t i) { level_.face_offsets[i] = drawn_corners(facets[i]); });
    counts_to_offsets(level_.face_offsets);
    level_.face_vertices.resize(static_cast<size_t>(level_.face_offsets.back()));
    parallel_for(count, run_, [&](int64_t i) {
      int32_t* next = corners(i).data();
      for_drawn_edges(facets[i], [&](int32_t vertex, int32_t) { *next++ = vertex; });
    });
  }

  // Numbers the vertices in the order in which the corners first use them.
  void number_corners() {
    const auto count = static_cast<int64_t>(level_.face_vertices.size());
    Column<int32_t>& corner = level_.face_vertices;
    auto first = array<int32_t>(complex_.cell.size(), INT32_MAX, run_);
    parallel_for(count, run_, [&](int64_t i) { lower(first[corner[i]], static_cast<int32_t>(i)); });
    parallel_append_to(level_.vertex_of, count, run_, [&](int64_t i, auto& out, int) {
      if (first[corner[i]] == i) out.push_back(corner[i]);
    });
    parallel_for(static_cast<int64_t>(level_.vertex_of.size()), run_,
                 [&](int64_t v) { number_[level_.vertex_of[v]] = static_cast<int32_t>(v); });
    parallel_for(count, run_, [&](int64_t i) { corner[i] = number_[corner[i]]; });
  }

  // Removes facets that have the same corners as an earlier one, in any order: two facets between
  // parallel edges look like one.
  void leave_twins_out(Array<int32_t>& facets) {
    // Per vertex, this is the newest facet that starts there; per facet, the one before it; or -1.
    auto newest = array<int32_t>(level_.vertex_of.size(), -1, run_);
    auto before = array<int32_t>(facets.size(), -1, run_);
    const auto is_twin = [&](int32_t i) {
      const auto polygon = corners(i);
      int32_t& start = newest[polygon[0]];
      for (int32_t other = start; other >= 0; other = before[other]) {
        const auto earlier = corners(other);
        if (std::is_permutation(earlier.begin(), earlier.end(), polygon.begin(), polygon.end())) {
          return true;
        }
      }
      before[i] = start;
      start = i;
      return false;
    };
    const std::vector<int32_t> twins = rows_where(facets.size(), is_twin);
    if (!twins.empty()) leave_out(twins, facets);
  }
  // Removes some facets, given by their ascending places in the list.
  void leave_out(std::span<const int32_t> some, Array<int32_t>& facets) {
    const auto count = static_cast<int64_t>(facets.size());
    int64_t left = 0;
    for (int64_t i = 0; i < count; ++i) {
      if (!some.empty() && some.front() == i) {
        some = some.subspan(1);
        continue;
      }
      const auto polygon = corners(i);
      std::copy(polygon.begin(), polygon.end(),
                level_.face_vertices.data() + level_.face_offsets[left]);
      level_.face_offsets[left + 1] =
          level_.face_offsets[left] + static_cast<int32_t>(polygon.size());
      facets[left++] = facets[i];
    }
    facets.resize(static_cast<size_t>(left));
    level_.face_offsets.resize(static_cast<size_t>(left) + 1);
    level_.face_vertices.resize(static_cast<size_t>(level_.face_offsets.back()));
  }

  void draw_wires() {
    const auto found =
        parallel_append<int32_t>(complex_.edges(), run_, [&](int64_t id, auto& out, int) {
          const auto e = static_cast<int32_t>(id);
          if (!alive_.edge[e]) return;
          if (is_loop(e)) {
            shared_add(level_.hidden, int64_t{1});
            return;
          }
          for (const int32_t v : complex_.ends[e]) shared_store(touched_[v], uint8_t{1});
          if (!used_[e]) out.push_back(e);
        });
    for (const int32_t e : found) {
      const auto& [a, b] = complex_.ends[e];
      level_.wires.push_back({number(a), number(b)});
      level_.edge_of.push_back(e);
    }
  }

  void draw_points() {
    const auto found =
        parallel_append<int32_t>(complex_.vertices(), run_, [&](int64_t v, auto& out, int) {
          if (alive_.vertex[v] && !touched_[v]) out.push_back(static_cast<int32_t>(v));
        });
    for (const int32_t v : found) level_.points.push_back(number(v));
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
    level_.place.assign(level_.vertex_of.size(), Placing::voronoi);
    if (h_.even) stand_for_others();
    if (!crisp_) return;
    parallel_for(static_cast<int64_t>(level_.vertex_of.size()), run_, [&](int64_t v) {
      level_.place[v] = h_.crisp.place[level_.vertex_of[v]];
      level_.vertices[v] = h_.crisp.position[level_.vertex_of[v]];
      level_.radius[v] = h_.crisp.radius[level_.vertex_of[v]];
    });
  }

  // Vertices of an even mesh stand for those of the complex that it was made of.
  void stand_for_others() {
    for (size_t v = 0; v < level_.vertex_of.size(); ++v) {
      level_.exact[v] = h_.even->exact[level_.vertex_of[v]];
      level_.exact_radius[v] = h_.even->exact_radius[level_.vertex_of[v]];
    }
  }

  void read_values() {
    const size_t facets = level_.facet_of.size(), wires = level_.edge_of.size();
    level_.sheet.resize(facets);
    level_.erosion.resize(facets);
    level_.limb.resize(wires);
    level_.theta.resize(facets);
    level_.rho.resize(facets);
    parallel_for(static_cast<int64_t>(facets), run_, [&](int64_t f) {
      const int32_t facet = level_.facet_of[f];
      level_.theta[f] = theta_of(h_.sine[facet]);
      level_.rho[f] = h_.rho[facet];
      level_.sheet[f] = h_.values.facet[facet].sheet;
      level_.erosion[f] = h_.values.facet[facet].erosion;
    });
    for (size_t w = 0; w < wires; ++w) level_.limb[w] = h_.limb_of_edge(level_.edge_of[w]);
  }

  const Hierarchy::Parts& h_;
  bool crisp_;
  const InnerComplex& complex_;
  const Alive& alive_;
  Run run_;
  uint8_t has_loops_ = 0;
  Array<uint8_t> used_;     // per edge: 1 if a facet is there
  Array<uint8_t> touched_;  // per vertex: 1 if an edge is there
  Array<int32_t> number_;   // per vertex: its number in the level
  Level level_;
};

}  // namespace

bool exceeds(const Thickness& value, const LevelOptions& t) {
  return exceeds(value.sheet, t.sheet) && exceeds(value.spacings, t.spacings) &&
         exceeds(value.erosion, t.erosion);
}

const SpikeValues& spikes(const Hierarchy::Parts& h, const Run& run) {
  std::call_once(h.spikes_known, [&] {
    // The values outlive the arena.
    h.spikes =
        spike_values(h.complex, h.partner, h.thickness, {run.threads, run.progress, nullptr});
  });
  return h.spikes;
}

Alive alive_at(const Hierarchy::Parts& h, const LevelOptions& t, const Run& run) {
  const InnerComplex& complex = h.complex;
  const SpikeValues* broad = t.spike > 0 ? &spikes(h, run) : nullptr;
  Alive alive{array<uint8_t>(complex.generators.size(), run),
              array<uint8_t>(complex.ends.size(), run), array<uint8_t>(complex.cell.size(), run)};
  parallel_for(complex.facets(), run, [&](int64_t f) {
    alive.facet[f] = exceeds(h.values.facet[f], t) && (!broad || exceeds(broad->facet[f], t.spike));
  });
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    alive.vertex[v] =
        (exceeds(h.values.vertex[v], t) && (!broad || exceeds(broad->vertex[v], t.spike))) ||
        h.limb[v] > t.limb;
  });
  parallel_for(complex.edges(), run, [&](int64_t e) {
    const int32_t partner = h.partner[e];
    alive.edge[e] = partner == kAlone ||
                    (partner >= 0 ? alive.facet[partner] : alive.vertex[with_vertex(partner)]);
  });
  return alive;
}

Level level(const Hierarchy::Parts& h, const LevelOptions& options, const Run& run) {
  check(options.sheet, "sheet");
  check(options.spacings, "spacings");
  check(options.erosion, "erosion");
  check(options.spike, "spike");
  check(options.limb, "limb");
  begin_stage(run.progress, "Limbs", 0, 0.3);
  const Run quiet{run.threads, nullptr, run.arena};
  Alive alive = alive_at(h, options, quiet);
  if (options.round_limbs) shed_flat_limbs(h, options, alive, run);
  begin_stage(run.progress, "Level", 0.3, options.relaxed ? 0.6 : 1);
  throw_if_cancelled(run.progress);
  const bool crisp = h.even || (options.crisp && !options.relaxed && !h.crisp.place.empty());
  Level level = Drawer(h, alive, crisp, quiet).draw();
  throw_if_cancelled(run.progress);
  level.betti = h.even ? betti_of(h.complex, h.betti[2], alive, quiet)
                       : betti_of(h.complex, h.outside, alive, quiet);
  if (h.even) smooth_new_rims(level, h, alive, run);
  if (options.relaxed) relax(level, h, options.crisp, run);
  advance(run.progress, 1);
  return level;
}

}  // namespace medial
