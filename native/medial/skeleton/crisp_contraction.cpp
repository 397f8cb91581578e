// SPDX-License-Identifier: GPL-3.0-or-later
#include <numeric>
#include <tuple>

#include "base/sort_unique.h"
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

constexpr double kLongestStep = 0.5;  // holes between the samples from a vertex to where it may go
constexpr int kContractionRounds = 8;
constexpr size_t kMostTogether = 32;  // vertices that move at once; the line of a fillet has more

class Contraction {
 public:
  explicit Contraction(CrispState& state) : c_(state), next_(state.complex.cell.size()) {
    std::iota(next_.begin(), next_.end(), 0);
    for (const int32_t v : c_.followers) std::swap(next_[v], next_[c_.follows[v]]);
  }

  void contract() {
    std::vector<int32_t> suspects = c_.facets;
    for (int round = 0; round < kContractionRounds; ++round) {
      throw_if_cancelled(c_.progress);
      suspects = folded(suspects);
      bool changed = false;
      for (const int32_t f : suspects) changed |= contract(f);
      if (!changed) return;
    }
  }

 private:
  struct Step {
    int32_t from, to;
    double length;
  };

  // A facet that was contracted to a line has no fold. Only here may one become a line: elsewhere
  // its corners would take the places of sheets beside it.
  bool is_folded(int32_t facet) const {
    return medial::is_folded(c_, facet, false) && has_area(c_, facet);
  }

  std::vector<int32_t> folded(std::span<const int32_t> of) const {
    return parallel_append<int32_t>(static_cast<int64_t>(of.size()), c_.run,
                                    [&](int64_t i, auto& out, int) {
                                      if (is_folded(of[i])) out.push_back(of[i]);
                                    });
  }

  // Takes the shortest step of a corner to the next one that leaves fewer folds, or else moves all
  // corners to one.
  bool contract(int32_t facet) {
    if (!is_folded(facet)) return false;
    std::vector<Step> steps = steps_of(facet);
    std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) {
      return std::tuple(a.length, a.from, a.to) < std::tuple(b.length, b.from, b.to);
    });
    const auto takes = [&](const Step& s) { return take({&s.from, 1}, s.to); };
    return std::any_of(steps.begin(), steps.end(), takes) || gather(facet);
  }

  bool gather(int32_t facet) {
    const auto ring = c_.complex.ring(facet);
    return std::any_of(ring.begin(), ring.end(), [&](const Corner& to) {
      std::vector<int32_t> from;
      for (const Corner& c : ring) {
        const double room = kLongestStep * c_.spacing_at(c.vertex);
        const Vec3 &here = c_.made.position[c.vertex], &there = c_.made.position[to.vertex];
        if (is_together(c.vertex, to.vertex)) continue;
        if (distance(here, there) > room || !is_free(c.vertex)) return false;
        from.push_back(c.vertex);
      }
      return take(from, to.vertex);
    });
  }

  bool is_together(int32_t a, int32_t b) const {
    bool found = false;
    for_group(a, [&](int32_t v) { found |= v == b; });
    return found;
  }

  // Returns whether a vertex is inside a sheet, where it may go anywhere.
  bool is_free(int32_t v) const {
    bool free = true;
    for_group(v, [&](int32_t u) { free &= !c_.on_rim[u] && !c_.on_seam[u] && !is_fixed(u); });
    return free;
  }

  bool is_fixed(int32_t v) const {
    const Placing place = c_.made.place[v];
    return place == Placing::corner || place == Placing::voronoi || c_.stays[v];
  }

  std::vector<Step> steps_of(int32_t facet) const {
    std::vector<Step> steps;
    const auto ring = c_.complex.ring(facet);
    for (size_t i = 0; i < ring.size(); ++i) {
      const int32_t a = ring[i].vertex, b = ring[(i + 1) % ring.size()].vertex;
      const double length = distance(c_.made.position[a], c_.made.position[b]);
      for (const auto& [from, to] : {Edge{a, b}, Edge{b, a}}) {
        if (length > kLongestStep * c_.spacing_at(from) || !may_go(from, to, ring[i].edge))
          continue;
        steps.push_back({from, to, length});
      }
    }
    return steps;
  }

  // Vertices of rims go along these, and those of seams along seams.
  bool may_go(int32_t from, int32_t to, int32_t edge) const {
    const int uses = c_.edge_uses[edge];
    bool may = true;
    for_group(from, [&](int32_t v) {
      const bool leaves =
          c_.made.place[v] == Placing::crease && c_.made.place[to] < Placing::crease;
      may &= v != to && !is_fixed(v) && !leaves && (!c_.on_rim[v] || uses == 1) &&
             (!c_.on_seam[v] || uses == 3);
    });
    return may;
  }

  // Calls found(v) for the vertices in the place of one, which move with it.
  template <typename Found>
  void for_group(int32_t of, const Found& found) const {
    int32_t v = of;
    do {
      found(v);
      v = next_[v];
    } while (v != of);
  }

  // Moves vertices, and those in their places, to the place of another one if that leaves fewer
  // folds.
  bool take(std::span<const int32_t> from, int32_t to) {
    const std::vector<int32_t> moving = groups_of(from);
    if (moving.size() > kMostTogether) return false;
    const std::vector<int32_t> facets = facets_at(moving);
    const size_t before = folded(facets).size();
    std::vector<Vec3> places;
    for (const int32_t v : moving) places.push_back(c_.made.position[v]);
    for (const int32_t v : moving) c_.made.position[v] = c_.made.position[to];
    if (folded(facets).size() >= before) {
      for (size_t i = 0; i < moving.size(); ++i) c_.made.position[moving[i]] = places[i];
      return false;
    }
    for (const int32_t v : moving) {
      c_.made.radius[v] = c_.made.radius[to];
      c_.made.place[v] = c_.made.place[to];
      c_.walls[v] = c_.walls[to];
    }
    for (const int32_t v : from) {
      if (!is_together(v, to)) std::swap(next_[v], next_[to]);
    }
    return true;
  }

  std::vector<int32_t> groups_of(std::span<const int32_t> vertices) const {
    std::vector<int32_t> all;
    for (const int32_t of : vertices) for_group(of, [&](int32_t v) { all.push_back(v); });
    sort_unique(all);
    return all;
  }

  std::vector<int32_t> facets_at(std::span<const int32_t> vertices) const {
    std::vector<int32_t> all;
    for (const int32_t v : vertices) {
      all.insert(all.end(), c_.facets_at[v].begin(), c_.facets_at[v].end());
    }
    sort_unique(all);
    return all;
  }

  CrispState& c_;
  std::vector<int32_t> next_;  // per vertex: the next one in its place, round to itself
};

}  // namespace

void contract_folds(CrispState& state) { Contraction(state).contract(); }

}  // namespace medial
