// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

// Lengths are in holes between the samples.
constexpr double kExact = 1e-10;     // the largest difference between a radius and the distance
constexpr double kFarthestMove = 2;  // that a vertex moves to touch walls
constexpr double kSameFoot = 0.08;   // between unit directions to feet that are one
constexpr int kMoreWalls = 8;        // attempts to mend walls that the ball sticks out of
constexpr double kNearlyEqual =
    1e-3;  // between the distances to walls of one ball, where they are rough

class WallFinder {
 public:
  explicit WallFinder(const CrispState& state) : c_(state) {}

  // Returns the walls of a vertex: its samples are of one wall where no facet separates them. On a
  // curved wall all samples mostly have one foot, so the first one will do unless `thorough`.
  Walls walls_at(int32_t v, bool thorough) const {
    const Groups groups = groups_at(v);
    Walls walls;
    for (size_t g = 0; g < groups.samples.size(); ++g) {
      if (groups.group[g] != g) continue;
      const int32_t t = nearest_wall(v, groups, g, thorough);
      if (t < 0) return {};
      if (!walls.add(t)) break;
    }
    return walls.count < 2 ? walls_of_facet(v) : walls;
  }

 private:
  // Holds the samples of a vertex, each with the first one of its group.
  struct Groups {
    std::vector<int32_t> samples;
    std::vector<size_t> group;

    size_t find(int32_t sample) {
      for (size_t i = 0; i < samples.size(); ++i) {
        if (samples[i] == sample) return i;
      }
      samples.push_back(sample);
      group.push_back(group.size());
      return group.size() - 1;
    }
    void unite(size_t a, size_t b) {
      const size_t low = std::min(group[a], group[b]), high = std::max(group[a], group[b]);
      for (size_t& g : group) {
        if (g == high) g = low;
      }
    }
  };

  Groups groups_at(int32_t v) const {
    Groups groups;
    for_cells(v, [&](const Cell& cell) {
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
          if (is_separated(v, cell[i], cell[j])) continue;
          const size_t a = groups.find(cell[i]), b = groups.find(cell[j]);
          groups.unite(a, b);
        }
        groups.find(cell[i]);
      }
    });
    return groups;
  }

  // Calls found(cell) for the cells that were merged into a vertex.
  template <typename Found>
  void for_cells(int32_t v, const Found& found) const {
    found(c_.triangulation.cells[c_.complex.cell[v]]);
    const auto& merged = c_.complex.merged;
    auto next = std::lower_bound(merged.begin(), merged.end(), Edge{v, -1});
    for (; next != merged.end() && (*next)[0] == v; ++next)
      found(c_.triangulation.cells[(*next)[1]]);
  }

  bool is_separated(int32_t v, int32_t p, int32_t q) const {
    const auto is_pair = [&](const Edge& g) {
      return (g[0] == p && g[1] == q) || (g[0] == q && g[1] == p);
    };
    for (const int32_t f : c_.facets_at[v]) {
      if (is_pair(c_.complex.generators[f])) return true;
    }
    auto next = std::lower_bound(c_.hidden.begin(), c_.hidden.end(), Hidden{v, -1, -1});
    for (; next != c_.hidden.end() && (*next)[0] == v; ++next) {
      if (is_pair({(*next)[1], (*next)[2]})) return true;
    }
    return false;
  }

  // Returns the triangle of the nearest foot of the samples of a group, or -1 if one has no face.
  int32_t nearest_wall(int32_t v, const Groups& groups, size_t group, bool thorough) const {
    Foot best;
    for (size_t i = 0; i < groups.samples.size(); ++i) {
      if (groups.group[i] != group) continue;
      const int32_t t = c_.samples.triangle(groups.samples[i]);
      if (t < 0) return -1;
      if (!thorough && c_.samples.faces().is_curved(t)) return t;
      const Foot foot = c_.samples.faces().descend(t, c_.complex.position[v]);
      if (foot.distance < best.distance) best = foot;
    }
    return best.triangle;
  }

  // Returns the walls of the facet that separates its samples most.
  Walls walls_of_facet(int32_t v) const {
    int32_t best = -1;
    for (const int32_t f : c_.facets_at[v]) {
      if (best < 0 || c_.sine[f] > c_.sine[best]) best = f;
    }
    Walls walls;
    for (const int32_t s : c_.complex.generators[best]) {
      if (c_.samples.triangle(s) < 0) return {};
      walls.add(c_.samples.triangle(s));
    }
    return walls;
  }

  const CrispState& c_;
};

// Finds the ball of a vertex that touches some walls and is empty.
class BallFinder {
 public:
  BallFinder(const CrispState& state, int32_t v)
      : samples_(state.samples),
        from_(state.complex.position[v]),
        spacing_(state.spacing_at(v)),
        tolerance_(kExact * spacing_) {}

  // A wall that the ball sticks out of is added, unless there are as many as it may touch. If it is
  // seen in the direction of a wall already there, the foot on that one was not the nearest.
  Touch find(Walls walls, Vec3 start, size_t most) const {
    for (int i = 0; i < kMoreWalls; ++i) {
      const Trial trial = tried(walls, start);
      if (!trial.is_ball) return {};
      if (!trial.nearer) return found(trial);
      if (!samples_.are_near(trial.nearer->point)) return {};
      start = trial.ball.centre;
      walls = trial.walls;
      const size_t same = same_place(trial);
      if (same < walls.count) {
        walls.triangle[same] = trial.nearer->triangle;
      } else if (walls.count >= most || !walls.add(trial.nearer->triangle)) {
        return {};
      }
    }
    return {};
  }

 private:
  struct Trial {
    TouchingBall ball;
    Walls walls;
    bool is_ball = false;        // whether it touches all walls, in two places at least
    std::optional<Foot> nearer;  // a place of the faces inside the ball
  };

  Trial tried(Walls walls, const Vec3& start) const {
    Trial trial{touching_ball(samples_.faces(), walls.all(), start), walls, false, {}};
    trial.walls = walls;
    const TouchingBall& ball = trial.ball;
    trial.is_ball = ball.unequal <= tolerance_ &&
                    distance(ball.centre, from_) <= kFarthestMove * spacing_ &&
                    touches_twice(ball, walls.count);
    if (trial.is_ball) {
      trial.nearer = samples_.faces().nearer(ball.centre, ball.radius - tolerance_);
    }
    return trial;
  }

  // Returns the wall whose foot is seen in the direction of a place inside the ball, or the number
  // of walls.
  static size_t same_place(const Trial& trial) {
    const Vec3 away = normalized(trial.ball.centre - trial.nearer->point);
    size_t i = 0;
    while (i < trial.walls.count && distance(trial.ball.away[i], away) > kSameFoot) ++i;
    return i;
  }

  // There are samples near all feet: a ball may have rolled to a face inside the solid, which
  // bounds nothing. And it is inside: where samples are far apart, it may have gone past an edge.
  Touch found(const Trial& trial) const {
    const TouchingBall& ball = trial.ball;
    if (!is_inside(trial)) return {};
    for (size_t i = 0; i < trial.walls.count; ++i) {
      if (!samples_.are_near(ball.centre - ball.radius * ball.away[i])) return {};
    }
    return {ball.centre, ball.radius, trial.walls, ball.away};
  }

  // Returns whether a wall is seen from its inner side. All of them are, except the walls of a
  // sharp reflex edge, which a ball rolls round.
  bool is_inside(const Trial& trial) const {
    for (size_t i = 0; i < trial.walls.count; ++i) {
      const Vec3& outward = samples_.faces().mesh().normal[trial.walls.triangle[i]];
      if (dot(trial.ball.away[i], outward) < 0) return true;
    }
    return false;
  }

  // Returns whether the feet are not all in one place, as they are beyond the rim of a sheet.
  static bool touches_twice(const TouchingBall& ball, size_t walls) {
    for (size_t i = 1; i < walls; ++i) {
      if (distance(ball.away[i], ball.away[0]) > kSameFoot) return true;
    }
    return false;
  }

  const SamplesOnFaces& samples_;
  const Vec3& from_;
  double spacing_, tolerance_;
};

}  // namespace

Walls walls_at(const CrispState& state, int32_t v, bool thorough) {
  return WallFinder(state).walls_at(v, thorough);
}

Touch touch(const CrispState& state, int32_t v, const Walls& walls, const Vec3& start,
            size_t most) {
  return BallFinder(state, v).find(walls, start, most);
}

Touch nearly_touching(const CrispState& state, int32_t v, Walls walls, const Vec3& start,
                      double within) {
  const Faces& faces = state.samples.faces();
  const double room = kNearlyEqual * state.spacing_at(v);
  const TouchingBall ball = touching_ball(faces, walls.all(), start);
  if (!(ball.unequal < room) || !(distance(ball.centre, start) < within)) return {};
  const auto nearest = faces.nearer(ball.centre, ball.radius + room);
  const bool touches = nearest && nearest->distance > ball.radius - room;
  if (!touches || !state.samples.are_near(nearest->point)) return {};
  return {ball.centre, nearest->distance, walls, ball.away};
}

}  // namespace medial
