// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp_parts.h"
#include "skeleton/rim_waves.h"

namespace medial {
namespace {

constexpr int kMostRounds = 400;    // of steps towards the middle of the neighbours along a rim
constexpr int kFirstRounds = 4;     // of these, the rounds in which all vertices take steps
constexpr int kEvenRounds = 4;      // of means along the rim of the ways to the end of the sheet
constexpr int kSmoothRounds = 300;  // of means of where the sheet ends: waves of 43 edges
// Lengths are in holes between the samples.
constexpr double kDeepest = 1;  // from a vertex to the end of the sheet that is found for it

class RimOrder {
 public:
  explicit RimOrder(CrispState& state) : c_(state) {
    for (int32_t v = 0; v < c_.complex.vertices(); ++v) {
      if (moves(v)) moving_.push_back(v);
    }
  }

  void order() {
    straighten();
    end_again();
    straighten();
    smooth_ends();
    flatten_ears();
    for (const int32_t v : moving_) c_.end_at(v, c_.made.position[v]);
  }

 private:
  bool moves(int32_t v) const {
    return c_.smooth_rim[v].reach > 0 && c_.is_open_rim(v) && c_.beside[v].size() >= 2;
  }

  void straighten() {
    std::vector<uint8_t> active(c_.complex.cell.size(), 1);
    std::vector<Vec3> next(moving_.size());
    for (int round = 0; round < kMostRounds; ++round) {
      throw_if_cancelled(c_.progress);
      if (round >= kFirstRounds && !find_turns(active)) return;
      for (size_t i = 0; i < moving_.size(); ++i) next[i] = step_of(moving_[i]);
      for (size_t i = 0; i < moving_.size(); ++i) {
        if (active[moving_[i]]) c_.made.position[moving_[i]] = next[i];
      }
    }
  }

  Vec3 step_of(int32_t v) const {
    Vec3 sum;
    for (const int32_t other : c_.beside[v]) sum = sum + c_.made.position[other];
    const double share = 0.5 / static_cast<double>(c_.beside[v].size());
    return 0.5 * c_.made.position[v] + share * sum;
  }

  // Marks the vertices where a rim turns back, and their neighbours; returns whether there are any.
  bool find_turns(std::vector<uint8_t>& active) const {
    std::fill(active.begin(), active.end(), uint8_t{0});
    bool found = false;
    for (const int32_t v : moving_) {
      if (!turns_back(v)) continue;
      found = true;
      active[v] = 1;
      for (const int32_t other : c_.beside[v]) active[other] = 1;
    }
    return found;
  }

  bool turns_back(int32_t v) const {
    const auto beside = c_.beside[v];
    if (beside.size() != 2) return false;
    const Vec3& here = c_.made.position[v];
    return dot(c_.made.position[beside[0]] - here, c_.made.position[beside[1]] - here) > 0;
  }

  // Moves the vertices to the end of the sheet, on smooth rims by ways that are means along the
  // rim.
  void end_again() {
    std::vector<Vec3> way(c_.complex.cell.size()), mean(moving_.size());
    parallel_for(
        static_cast<int64_t>(moving_.size()), c_.run,
        [&](int64_t i) {
          const int32_t v = moving_[i];
          way[v] = end_near(v) - c_.made.position[v];
        },
        64);
    for (int round = 0; round < kEvenRounds; ++round) {
      for (size_t i = 0; i < moving_.size(); ++i) mean[i] = mean_way(moving_[i], way);
      for (size_t i = 0; i < moving_.size(); ++i) way[moving_[i]] = mean[i];
    }
    for (const int32_t v : moving_) c_.made.position[v] = c_.made.position[v] + way[v];
  }

  // Each vertex finds the end of the sheet alone, from how curved the faces are, and the curvature
  // of curved triangles is rough. Vertices move out of the sheet or into it, so that short waves
  // are gone.
  void smooth_ends() {
    std::vector<std::span<const int32_t>> beside;
    for (const int32_t v : moving_) beside.push_back(c_.beside[v]);
    const RimWaves waves(moving_, beside, c_.made.position.size(), kSmoothRounds);
    const std::vector<Vec3> moves = waves.moves(c_.made.position);
    for (size_t i = 0; i < moving_.size(); ++i) {
      const int32_t v = moving_[i];
      const Vec3& outward = c_.smooth_rim[v].outward;
      const double room = kDeepest * c_.spacing_at(v);
      const double way = std::clamp(dot(moves[i], outward), -room, room);
      c_.made.position[v] = c_.made.position[v] + way * outward;
    }
  }

  Vec3 mean_way(int32_t v, std::span<const Vec3> way) const {
    Vec3 sum;
    for (const int32_t other : c_.beside[v]) sum = sum + way[other];
    return 0.5 * way[v] + (0.5 / static_cast<double>(c_.beside[v].size())) * sum;
  }

  // Returns the end of the sheet near to where a vertex has moved to.
  Vec3 end_near(int32_t v) const {
    const Vec3& here = c_.made.position[v];
    const SmoothRim& rim = c_.smooth_rim[v];
    const Touch inner = touch(c_, v, c_.walls[v], here - rim.reach * rim.outward);
    if (!(inner.radius > 0) || inner.walls.count != 2) return here;
    const SmoothRim again = smooth_rim_of(c_.samples.faces(), c_.spacing_at(v), inner);
    const Vec3 place = inner.position + again.reach * again.outward;
    return again.reach > 0 && distance(place, here) < kDeepest * c_.spacing_at(v) ? place : here;
  }

  // A facet all of whose corners are on the rim is turned over where the rim is not convex. Its
  // corners that no other facet has go onto the line between the others.
  void flatten_ears() {
    for (const int32_t f : c_.facets) {
      const auto ring = c_.complex.ring(f);
      const bool on_rim =
          std::all_of(ring.begin(), ring.end(), [&](const Corner& c) { return moves(c.vertex); });
      if (!on_rim || !is_folded(c_, f, false)) continue;
      for (size_t first = 0; first < ring.size(); ++first) {
        if (c_.facets_at[ring[first].vertex].size() > 1) flatten(ring, first);
      }
    }
  }

  // Moves the corners after one, up to the next one that other facets have, onto the line between.
  void flatten(std::span<const Corner> ring, size_t first) {
    size_t last = first + 1;
    const auto vertex = [&](size_t i) { return ring[i % ring.size()].vertex; };
    while (c_.facets_at[vertex(last)].size() == 1) ++last;
    const Vec3 &from = c_.made.position[vertex(first)], &to = c_.made.position[vertex(last)];
    for (size_t i = first + 1; i < last; ++i) {
      const double share = static_cast<double>(i - first) / static_cast<double>(last - first);
      c_.made.position[vertex(i)] = from + share * (to - from);
    }
  }

  CrispState& c_;
  std::vector<int32_t> moving_;
};

}  // namespace

void order_rims(CrispState& state) { RimOrder(state).order(); }

}  // namespace medial
