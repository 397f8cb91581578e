// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/rims.h"

#include "base/csr.h"
#include "base/sort_unique.h"
#include "skeleton/rim_waves.h"

namespace medial {
namespace {

constexpr int kSteps = 3;
constexpr int kRimMeans = 40;  // of means along the rim: waves of 16 edges
constexpr int kHalvings = 6;   // of a step that folds a facet; after these the vertex stays

class Relaxer {
 public:
  Relaxer(const Polygons& polygons, std::span<const Edge> rims, std::span<Vec3> places,
          const Run& run)
      : polygons_(polygons),
        places_(places),
        run_(run),
        row_(array<int32_t>(places.size(), -1, run)) {
    find_moving(rims);
    find_touched();
  }

  std::vector<int32_t> relax() && {
    const RimWaves waves(moving_, {neighbours_.begin(), neighbours_.end()}, places_.size(),
                         kRimMeans);
    for (int step = 0; step < kSteps; ++step) {
      throw_if_cancelled(run_.progress);
      take_step(waves);
    }
    return std::move(moving_);
  }

 private:
  struct Neighbours {
    int32_t count = 0;
    std::array<int32_t, 2> ids{};
  };

  void find_moving(std::span<const Edge> rims) {
    auto at = array<Neighbours>(places_.size(), Neighbours{}, run_);
    for (const auto& [a, b] : rims) {
      for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)}) {
        Neighbours& n = at[v];
        if (n.count < 2) n.ids[n.count] = other;
        ++n.count;
      }
    }
    for (size_t v = 0; v < at.size(); ++v) {
      if (at[v].count != 2) continue;
      row_[v] = static_cast<int32_t>(moving_.size());
      moving_.push_back(static_cast<int32_t>(v));
      neighbours_.push_back(at[v].ids);
    }
  }

  // Finds the facets with a vertex that moves, and their orientation.
  void find_touched() {
    const auto facets = static_cast<int64_t>(polygons_.offsets.size()) - 1;
    touched_ = parallel_append<int32_t>(facets, run_, [&](int64_t f, auto& out, int) {
      for (const int32_t v : corners(f)) {
        if (row_[v] < 0) continue;
        out.push_back(static_cast<int32_t>(f));
        return;
      }
    });
    upright_.resize(touched_.size());
    parallel_for(static_cast<int64_t>(touched_.size()), run_,
                 [&](int64_t t) { upright_[t] = area(touched_[t]); });
    touched_at_.offsets = array<int64_t>(moving_.size() + 1, 0, run_);
    auto& offsets = touched_at_.offsets;
    for_touched([&](int32_t, int32_t row) { ++offsets[row]; });
    counts_to_offsets(offsets);
    touched_at_.items = array<int32_t>(static_cast<size_t>(offsets.back()), run_);
    std::vector<int64_t> next(offsets.begin(), offsets.end());
    for_touched([&](int32_t t, int32_t row) { touched_at_.items[next[row]++] = t; });
  }

  // Calls found(t, row) for the vertices that move at touched facets.
  template <typename Found>
  void for_touched(const Found& found) const {
    for (size_t t = 0; t < touched_.size(); ++t) {
      for (const int32_t v : corners(touched_[t])) {
        if (row_[v] >= 0) found(static_cast<int32_t>(t), row_[v]);
      }
    }
  }

  std::span<const int32_t> corners(int64_t f) const {
    return polygons_.corners.subspan(
        static_cast<size_t>(polygons_.offsets[f]),
        static_cast<size_t>(polygons_.offsets[f + 1] - polygons_.offsets[f]));
  }

  // Returns twice the area vector of a facet.
  Vec3 area(int32_t facet) const {
    const auto ring = corners(facet);
    Vec3 sum;
    for (size_t k = 2; k < ring.size(); ++k) {
      sum =
          sum + cross(places_[ring[k - 1]] - places_[ring[0]], places_[ring[k]] - places_[ring[0]]);
    }
    return sum;
  }

  // Moves vertices to where the rim has no short waves; where facets fold, half of that, and so on.
  void take_step(const RimWaves& waves) {
    std::vector<Vec3> from;
    for (const int32_t v : moving_) from.push_back(places_[v]);
    const std::vector<Vec3> move = waves.moves(places_);
    for (size_t i = 0; i < moving_.size(); ++i) places_[moving_[i]] = from[i] + move[i];
    std::vector<int> halvings(moving_.size(), 0);
    auto folded = folded_of(static_cast<int64_t>(touched_.size()), [](int64_t t) { return t; });
    while (!folded.empty()) {
      const auto smaller = halve(folded, halvings);
      for (const int32_t i : smaller) {
        const double share = halvings[i] > kHalvings ? 0 : std::ldexp(1.0, -halvings[i]);
        places_[moving_[i]] = from[i] + share * move[i];
      }
      const auto near = facets_at(smaller);
      folded = folded_of(static_cast<int64_t>(near.size()), [&](int64_t k) { return near[k]; });
    }
  }

  // Returns those of the given touched facets that are turned over.
  template <typename Which>
  std::vector<int32_t> folded_of(int64_t count, const Which& which) const {
    return parallel_append<int32_t>(count, run_, [&](int64_t k, auto& out, int) {
      const auto t = which(k);
      if (dot(area(touched_[t]), upright_[t]) < 0) out.push_back(static_cast<int32_t>(t));
    });
  }

  // Halves the steps of the vertices of folded facets, if they can still be halved; returns these
  // vertices, ascending.
  std::vector<int32_t> halve(std::span<const int32_t> folded, std::vector<int>& halvings) const {
    std::vector<int32_t> rows;
    for (const int32_t t : folded) {
      for (const int32_t v : corners(touched_[t])) {
        if (row_[v] >= 0 && halvings[row_[v]] <= kHalvings) rows.push_back(row_[v]);
      }
    }
    sort_unique(rows);
    for (const int32_t i : rows) ++halvings[i];
    return rows;
  }

  std::vector<int32_t> facets_at(std::span<const int32_t> rows) const {
    std::vector<int32_t> facets;
    for (const int32_t i : rows) {
      const auto own = touched_at_[i];
      facets.insert(facets.end(), own.begin(), own.end());
    }
    sort_unique(facets);
    return facets;
  }

  Polygons polygons_;
  std::span<Vec3> places_;
  Run run_;
  Array<int32_t> row_;  // per vertex: its place in moving_, or -1 if it stays
  std::vector<int32_t> moving_;
  std::vector<Edge> neighbours_;
  std::vector<int32_t> touched_;
  std::vector<Vec3> upright_;  // twice their area vectors before the first step
  Csr<int32_t> touched_at_;    // per moving vertex: places in touched_
};

}  // namespace

std::vector<int32_t> relax_rims(const Polygons& polygons, std::span<const Edge> rims,
                                std::span<Vec3> places, const Run& run) {
  return Relaxer(polygons, rims, places, run).relax();
}

}  // namespace medial
