// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/union_find.h"
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

// A smooth rim is looked for where a ball touches two places that are seen under less than 84
// degrees.
constexpr double kMostOpen = 0.45;          // the squared sine of half the angle
constexpr double kFarOut = 0.8;             // of the way to the rim that balls are tried on
constexpr double kFarthestRim = 0.5;        // from the last vertex to the rim, in radii
constexpr double kLongerThanBeside = 1.25;  // of the way of a vertex to that of its neighbours
constexpr int kRimRounds = 3;
constexpr double kCertainRim = 0.85;  // of the vertices of a rim must have found it
constexpr double kBent = 0.4;  // the largest deviation from a line, as a share of the openness
constexpr int kRimSteps = 4;

class SmoothRims {
 public:
  explicit SmoothRims(CrispState& state) : c_(state) {}

  // Moves a vertex of a smooth rim outward to where the two feet become one: there the openness is
  // 0. It falls linearly towards the rim; the line is fitted to several balls on the way, because
  // the curvature of curved triangles jumps from one to the next.
  void find(int32_t v, const Touch& inner) {
    const double first = openness(inner.away);
    if (!(first < kMostOpen)) return;
    const double farthest = kFarthestRim * inner.radius;
    const Vec3 outward = -normalized(inner.away[0] + inner.away[1]);
    double reach = distance_to_rim(inner, 0.25 * c_.spacing_at(v) * outward, 1);
    for (int i = 0; i < 2; ++i) {
      if (!(reach < farthest)) return;
      reach = distance_to_rim(inner, (kFarOut * reach / kRimSteps) * outward, kRimSteps);
    }
    if (reach < farthest) c_.smooth_rim[v] = {outward, reach};
  }

  // Moves the vertices of smooth rims. A vertex goes no farther than the rim beside it does.
  void settle() {
    for (int round = 0; round < kRimRounds; ++round) {
      auto settled = array<double>(c_.smooth_rim.size(), c_.run);
      parallel_for(c_.complex.vertices(), c_.run,
                   [&](int64_t v) { settled[v] = settled_reach(static_cast<int32_t>(v)); });
      for (size_t v = 0; v < c_.smooth_rim.size(); ++v) c_.smooth_rim[v].reach = settled[v];
    }
    leave_doubtful_rims();
    parallel_for(c_.complex.vertices(), c_.run, [&](int64_t v) {
      if (c_.smooth_rim[v].reach > 0) {
        end_on_rim(static_cast<int32_t>(v),
                   c_.made.position[v] + c_.smooth_rim[v].reach * c_.smooth_rim[v].outward);
      }
    });
  }

 private:
  // A rim moves as a whole or not at all: where too few of its vertices have found the end of the
  // sheet, as on noisy bodies, it would become ragged.
  void leave_doubtful_rims() {
    UnionFind rims(c_.smooth_rim.size());
    for (size_t e = 0; e < c_.complex.ends.size(); ++e) {
      if (c_.edge_uses[e] == 1) rims.unite(c_.complex.ends[e][0], c_.complex.ends[e][1]);
    }
    const auto rim = std::move(rims).representatives();
    std::vector<int32_t> all(c_.smooth_rim.size(), 0), found(c_.smooth_rim.size(), 0);
    for (int32_t v = 0; v < c_.complex.vertices(); ++v) {
      if (!c_.on_rim[v] || c_.made.place[v] >= Placing::rim) continue;
      ++all[rim[v]];
      found[rim[v]] += c_.smooth_rim[v].reach > 0;
    }
    for (int32_t v = 0; v < c_.complex.vertices(); ++v) {
      if (found[rim[v]] < kCertainRim * all[rim[v]]) c_.smooth_rim[v].reach = 0;
    }
  }

  double settled_reach(int32_t v) const {
    if (!(c_.smooth_rim[v].reach > 0)) return 0;
    std::vector<double> beside{c_.smooth_rim[v].reach};
    c_.for_edges(v, [&](const Corner& c, int32_t other) {
      if (c_.edge_uses[c.edge] == 1) beside.push_back(c_.smooth_rim[other].reach);
    });
    const auto middle = beside.begin() + static_cast<std::ptrdiff_t>((beside.size() - 1) / 2);
    std::nth_element(beside.begin(), middle, beside.end());
    return std::min(c_.smooth_rim[v].reach, kLongerThanBeside * *middle);
  }

  // Returns how far the openness of the balls after some steps lets the rim be; infinite if it does
  // not fall, or not linearly. At the rim of a fillet it drops at once where the balls of the
  // fillet have their common centre.
  double distance_to_rim(const Touch& inner, const Vec3& step, int steps) const {
    Walls walls = inner.walls;
    Vec3 position = inner.position;
    const double first = openness(inner.away);
    double products = 0, squares = 0;
    std::vector<std::array<double, 2>> lost;  // how far, and how much of the openness
    for (int i = 0; i < steps; ++i) {
      const TouchingBall ball = touching_ball(c_.samples.faces(), walls.all(), position + step);
      position = ball.centre;
      const double along = distance(position, inner.position);
      lost.push_back({along, first - openness(ball.away)});
      products += along * lost.back()[1];
      squares += along * along;
    }
    if (!(products > 0)) return HUGE_VAL;
    const double slope = products / squares;
    const bool straight = std::all_of(lost.begin(), lost.end(), [&](const auto& at) {
      return std::abs(at[1] - slope * at[0]) < kBent * first;
    });
    return straight ? first / slope : HUGE_VAL;
  }

  // Returns the squared sine of half the angle between the directions to the first two feet.
  static double openness(const std::array<Vec3, kMostContacts>& away) {
    return 0.5 * (1 - dot(away[0], away[1]));
  }

  void end_on_rim(int32_t v, const Vec3& position) {
    const auto foot = c_.samples.faces().nearer(position, HUGE_VAL);
    if (!c_.samples.are_near(foot->point)) return;
    c_.made.position[v] = position;
    c_.made.radius[v] = foot->distance;
    c_.made.place[v] = Placing::rim;
  }

  CrispState& c_;
};

}  // namespace

void find_smooth_rim(CrispState& state, int32_t v, const Touch& inner) {
  SmoothRims(state).find(v, inner);
}

void settle_smooth_rims(CrispState& state) { SmoothRims(state).settle(); }

}  // namespace medial
