// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/rims.h"

#include "base/csr.h"

namespace medial {
namespace {

constexpr int kSteps = 5;
constexpr double kFactor = 0.5;
constexpr int kHalvings = 6;  // of a step that folds a facet; after these the vertex stays

// Waves of a rim that are shorter than about seventy of its edges are taken out, and longer ones
// stay.
constexpr int kBandPasses = 3;
constexpr int kWaveRounds = 200;
constexpr double kInwards = 0.5, kOutwards = -0.501;
constexpr int kRings = 10;         // of vertices along the rim that move with it
constexpr int kSpreadRounds = 24;  // of the moves of the rim over these

class Relaxer {
 public:
  Relaxer(const Polygons& polygons, std::span<const Edge> rims, std::span<Vec3> places,
          const Run& run)
      : polygons_(polygons),
        places_(places),
        run_(run),
        row_(array<int32_t>(places.size(), -1, run)) {
    find_moving(rims);
  }

  std::vector<int32_t> relax() && {
    find_touched();
    for (int step = 0; step < kSteps; ++step) {
      throw_if_cancelled(run_.progress);
      take_step(moves_to_middles());
    }
    return std::move(moving_);
  }

  std::vector<int32_t> relax_bands(std::span<const uint8_t> pinned,
                                   std::span<const Vec3> across) && {
    add_band(pinned);
    find_touched();
    parallel_for(static_cast<int64_t>(touched_.size()), run_, [&](int64_t t) {
      const Vec3& way = across[touched_[t]];
      const double along = dot(way, upright_[t]);
      if (along != 0) upright_[t] = along < 0 ? -way : way;
    });
    find_beside();
    was_simple_.resize(touched_.size());
    parallel_for(static_cast<int64_t>(touched_.size()), run_,
                 [&](int64_t t) { was_simple_[t] = is_simple(t); });
    for (int pass = 0; pass < kBandPasses; ++pass) {
      throw_if_cancelled(run_.progress);
      take_step(moves_of_band());
    }
    std::sort(moving_.begin(), moving_.end());
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

  // Adds the vertices of some rings inside the rim to those that move.
  void add_band(std::span<const uint8_t> pinned) {
    const auto facets = static_cast<int64_t>(polygons_.offsets.size()) - 1;
    int32_t first = 0;
    for (int ring = 0; ring < kRings; ++ring) {
      const auto reached = parallel_append<int32_t>(facets, run_, [&](int64_t f, auto& out, int) {
        const auto ring_of = corners(f);
        if (std::none_of(ring_of.begin(), ring_of.end(),
                         [&](int32_t v) { return row_[v] >= first; })) {
          return;
        }
        for (const int32_t v : ring_of) {
          if (row_[v] < 0 && !pinned[v]) out.push_back(v);
        }
      });
      first = static_cast<int32_t>(moving_.size());
      std::vector<int32_t> next(reached.begin(), reached.end());
      sort_out(next);
      for (const int32_t v : next) {
        row_[v] = static_cast<int32_t>(moving_.size());
        moving_.push_back(v);
      }
    }
  }

  // Lists the neighbours of the vertices that move. Where three facets meet, a vertex stays: it is
  // on a seam.
  void find_beside() {
    std::vector<Edge> pairs;
    for (const int32_t f : touched_) {
      const auto ring = corners(f);
      for (size_t k = 0; k < ring.size(); ++k) {
        const int32_t a = ring[k], b = ring[k + 1 < ring.size() ? k + 1 : 0];
        if (row_[a] >= 0) pairs.push_back({row_[a], b});
        if (row_[b] >= 0) pairs.push_back({row_[b], a});
      }
    }
    std::sort(pairs.begin(), pairs.end());
    stays_.assign(moving_.size(), 0);
    for (size_t i = 2; i < pairs.size(); ++i) {
      if (pairs[i] == pairs[i - 2]) stays_[pairs[i][0]] = 1;
    }
    beside_ = csr_of_pairs(pairs, moving_.size(), run_);
  }

  std::vector<Vec3> moves_to_middles() const {
    std::vector<Vec3> moves;
    for (size_t i = 0; i < moving_.size(); ++i) {
      const auto& [a, b] = neighbours_[i];
      moves.push_back(kFactor * (0.5 * (places_[a] + places_[b]) - places_[moving_[i]]));
    }
    return moves;
  }

  // Returns the moves that take short waves out of the rim, and those of the band that follow it.
  // They lie in the sheet.
  std::vector<Vec3> moves_of_band() const {
    auto moves = moves_of_waves();
    moves.resize(moving_.size());
    const auto is_at_rest = [&](size_t i) { return stays_[i] != 0; };
    for (size_t i = 0; i < neighbours_.size(); ++i) {
      moves[i] = is_at_rest(i) ? Vec3{} : within_sheet(i, moves[i]);
    }
    auto next = moves;
    for (int round = 0; round < kSpreadRounds; ++round) {
      parallel_for(static_cast<int64_t>(moving_.size()), run_, [&](int64_t i) {
        if (i < static_cast<int64_t>(neighbours_.size()) || is_at_rest(i)) return;
        Vec3 sum;
        for (const int32_t v : beside_[i]) {
          if (row_[v] >= 0) sum = sum + moves[row_[v]];
        }
        next[i] = within_sheet(i, (1.0 / static_cast<double>(beside_[i].size())) * sum);
      });
      std::swap(moves, next);
    }
    return moves;
  }

  std::vector<Vec3> moves_of_waves() const {
    std::vector<Vec3> at(neighbours_.size()), next(neighbours_.size());
    for (size_t i = 0; i < at.size(); ++i) at[i] = places_[moving_[i]];
    const auto place = [&](int32_t v) {
      const int32_t row = row_[v];
      return row >= 0 && row < static_cast<int32_t>(at.size()) ? at[row] : places_[v];
    };
    for (int round = 0; round < 2 * kWaveRounds; ++round) {
      for (size_t i = 0; i < at.size(); ++i) {
        const auto& [a, b] = neighbours_[i];
        const Vec3 bend = 0.5 * (place(a) + place(b)) - at[i];
        next[i] = stays_[i] ? at[i] : at[i] + (round % 2 == 0 ? kInwards : kOutwards) * bend;
      }
      std::swap(at, next);
    }
    for (size_t i = 0; i < at.size(); ++i) at[i] = at[i] - places_[moving_[i]];
    return at;
  }

  // Takes the part of a move that is across the facets at a vertex away.
  Vec3 within_sheet(size_t row, const Vec3& move) const {
    Vec3 normal;
    for (const int32_t t : touched_at_[row]) {
      normal = normal + (dot(upright_[t], normal) < 0 ? -upright_[t] : upright_[t]);
    }
    const double squared = squared_length(normal);
    return squared > 0 ? move - (dot(move, normal) / squared) * normal : move;
  }

  // Moves vertices; where facets fold, by half as much, and so on.
  void take_step(const std::vector<Vec3>& move) {
    std::vector<Vec3> from;
    for (const int32_t v : moving_) from.push_back(places_[v]);
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

  // Returns whether no two sides of a touched facet cross, seen across it.
  bool is_simple(int64_t t) const {
    const auto ring = corners(touched_[t]);
    const auto at = [&](size_t k) { return places_[ring[k % ring.size()]]; };
    const auto is_left = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      return dot(cross(b - a, c - a), upright_[t]) > 0;
    };
    for (size_t i = 0; i + 2 < ring.size(); ++i) {
      for (size_t j = i + 2; j < ring.size() - (i == 0 ? 1 : 0); ++j) {
        const Vec3 a = at(i), b = at(i + 1), c = at(j), d = at(j + 1);
        if (is_left(a, b, c) != is_left(a, b, d) && is_left(c, d, a) != is_left(c, d, b)) {
          return false;
        }
      }
    }
    return true;
  }

  // Returns those of the given touched facets that are turned over.
  template <typename Which>
  std::vector<int32_t> folded_of(int64_t count, const Which& which) const {
    return parallel_append<int32_t>(count, run_, [&](int64_t k, auto& out, int) {
      const auto t = which(k);
      const bool over = dot(area(touched_[t]), upright_[t]) < 0;
      if (over || (!was_simple_.empty() && was_simple_[t] && !is_simple(t)))
        out.push_back(static_cast<int32_t>(t));
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
    sort_out(rows);
    for (const int32_t i : rows) ++halvings[i];
    return rows;
  }

  std::vector<int32_t> facets_at(std::span<const int32_t> rows) const {
    std::vector<int32_t> facets;
    for (const int32_t i : rows) {
      const auto own = touched_at_[i];
      facets.insert(facets.end(), own.begin(), own.end());
    }
    sort_out(facets);
    return facets;
  }

  static void sort_out(std::vector<int32_t>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }

  Polygons polygons_;
  std::span<Vec3> places_;
  Run run_;
  Array<int32_t> row_;  // per vertex: its place in moving_, or -1 if it stays
  std::vector<int32_t> moving_;
  std::vector<Edge> neighbours_;  // along the rim, of the first ones that move
  std::vector<uint8_t> stays_;    // per moving vertex of a band: on a seam
  Csr<int32_t> beside_;           // per moving vertex of a band
  std::vector<int32_t> touched_;
  std::vector<uint8_t> was_simple_;  // per touched facet of a band: no sides crossed
  std::vector<Vec3> upright_;        // twice their area vectors before the first step
  Csr<int32_t> touched_at_;          // per moving vertex: places in touched_
};

}  // namespace

std::vector<int32_t> relax_rims(const Polygons& polygons, std::span<const Edge> rims,
                                std::span<Vec3> places, const Run& run) {
  return Relaxer(polygons, rims, places, run).relax();
}

std::vector<int32_t> relax_rim_bands(const Polygons& polygons, std::span<const Edge> rims,
                                     std::span<const uint8_t> pinned, std::span<const Vec3> across,
                                     std::span<Vec3> places, const Run& run) {
  return Relaxer(polygons, rims, places, run).relax_bands(pinned, across);
}

}  // namespace medial
