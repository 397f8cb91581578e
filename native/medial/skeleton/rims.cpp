// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/rims.h"

#include "base/parallel.h"

namespace medial {
namespace {

constexpr int kSteps = 5;
constexpr double kFactor = 0.5;
constexpr int kHalvings = 6;  // of a step that folds a facet; after these it is not taken

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
    for (int step = 0; step < kSteps; ++step) {
      throw_if_cancelled(run_.progress);
      take_step();
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

  // The facets with a vertex that moves, and how they lie.
  void find_touched() {
    const auto facets = static_cast<int64_t>(polygons_.offsets.size()) - 1;
    touched_ = parallel_append<int32_t>(facets, run_, [&](int64_t f, auto& out, int) {
      for (const int32_t v : corners(f)) {
        if (row_[v] < 0) continue;
        out.push_back(static_cast<int32_t>(f));
        return;
      }
    });
    for (const int32_t f : touched_) upright_.push_back(area(f));
  }

  std::span<const int32_t> corners(int64_t f) const {
    return polygons_.corners.subspan(
        static_cast<size_t>(polygons_.offsets[f]),
        static_cast<size_t>(polygons_.offsets[f + 1] - polygons_.offsets[f]));
  }

  // Twice the area vector.
  Vec3 area(int32_t facet) const {
    const auto ring = corners(facet);
    Vec3 sum;
    for (size_t k = 2; k < ring.size(); ++k) {
      sum =
          sum + cross(places_[ring[k - 1]] - places_[ring[0]], places_[ring[k]] - places_[ring[0]]);
    }
    return sum;
  }

  void take_step() {
    std::vector<Vec3> from, move;
    for (size_t i = 0; i < moving_.size(); ++i) {
      const auto& [a, b] = neighbours_[i];
      from.push_back(places_[moving_[i]]);
      move.push_back(kFactor * (0.5 * (places_[a] + places_[b]) - from[i]));
    }
    std::vector<int> halvings(moving_.size(), 0);
    do {
      for (size_t i = 0; i < moving_.size(); ++i) {
        const double share = halvings[i] > kHalvings ? 0 : std::ldexp(1.0, -halvings[i]);
        places_[moving_[i]] = from[i] + share * move[i];
      }
    } while (step_back(halvings));
  }

  // Whether any facet lies the wrong way round; the steps of its vertices are halved.
  bool step_back(std::vector<int>& halvings) const {
    std::vector<uint8_t> folds(moving_.size(), 0);
    bool any = false;
    for (size_t i = 0; i < touched_.size(); ++i) {
      if (dot(area(touched_[i]), upright_[i]) >= 0) continue;
      for (const int32_t v : corners(touched_[i])) {
        if (row_[v] >= 0) folds[row_[v]] = 1;
      }
    }
    for (size_t i = 0; i < folds.size(); ++i) {
      if (!folds[i] || halvings[i] > kHalvings) continue;
      ++halvings[i];
      any = true;
    }
    return any;
  }

  Polygons polygons_;
  std::span<Vec3> places_;
  Run run_;
  Array<int32_t> row_;  // per vertex: in moving_; -1: it stays
  std::vector<int32_t> moving_;
  std::vector<Edge> neighbours_;
  std::vector<int32_t> touched_;
  std::vector<Vec3> upright_;
};

}  // namespace

std::vector<int32_t> relax_rims(const Polygons& polygons, std::span<const Edge> rims,
                                std::span<Vec3> places, const Run& run) {
  return Relaxer(polygons, rims, places, run).relax();
}

}  // namespace medial
