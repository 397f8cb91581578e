// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/flat_polygon.h"
#include "base/sort_unique.h"
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

// A stage ends after so many folded vertices, per vertex of all, in rounds that unfold nothing. It
// also ends after so many steps in rounds that unfold next to nothing, or a fixed number of steps
// where there are few vertices.
constexpr double kIdle = 0.1;
constexpr size_t kFewSteps = 4'000;
constexpr double kNextToNothing = 0.02;  // the share of the folded vertices
constexpr double kDeepDent = 0.25;       // the sine of the turn

constexpr double kAside = 0.1;  // holes from a place to one where a ball nearly touches walls

// Tells how many rounds a stage has at most, and how much is moved in each: whether deep dents are
// mended, too, how many rings of neighbours round the folded facets move, in how many steps, and
// whether balls nearly touch walls afterwards.
struct Stage {
  int rounds;
  bool dented;
  int rings, steps;
  bool nearly;
};

constexpr Stage kNarrow[] = {
    {3, true, 0, 1, false}, {3, true, 1, 1, false}, {18, false, 1, 1, false}};
constexpr Stage kWide[] = {{8, false, 2, 4, true}, {8, false, 3, 12, true}};

constexpr int rounds_of(std::span<const Stage> stages) {
  int sum = 0;
  for (const Stage& stage : stages) sum += stage.rounds;
  return sum;
}
constexpr double kAllRounds = rounds_of(kNarrow) + rounds_of(kWide);

class Unfolder {
 public:
  explicit Unfolder(CrispState& state) : c_(state) {}

  // Where little steps leave folds, wider ones are taken. They are taken back if they leave as
  // many: a facet all of whose corners are nearly in one place cannot be unfolded, and its
  // neighbours would fold in its stead.
  void unfold() {
    std::vector<int32_t> suspects = c_.facets;
    for (const Stage& stage : kNarrow) take_rounds(stage, suspects);
    const int64_t left = folded_facets(suspects);
    if (left == 0) return;
    const Places before{c_.made.position, c_.made.radius, c_.made.place, c_.walls};
    for (const Stage& stage : kWide) {
      if (folded_facets(suspects) > left) break;  // still wider steps would fold more
      take_rounds(stage, suspects);
    }
    if (folded_facets(suspects) < left) return;
    c_.made.position = before.position;
    c_.made.radius = before.radius;
    c_.made.place = before.place;
    c_.walls = before.walls;
  }

 private:
  struct Places {
    decltype(CrispPlaces::position) position;
    decltype(CrispPlaces::radius) radius;
    decltype(CrispPlaces::place) place;
    Array<Walls> walls;
  };

  int64_t folded_facets(std::span<const int32_t> suspects) const {
    return std::count_if(suspects.begin(), suspects.end(), [&](int32_t facet) {
      return can_unfold(facet) && is_folded(c_, facet, false);
    });
  }

  // Returns whether a corner of a facet may move. The facets of the web at a fillet have none.
  bool can_unfold(int32_t facet) const {
    const auto ring = c_.complex.ring(facet);
    return std::any_of(ring.begin(), ring.end(), [&](const Corner& c) { return moves(c.vertex); });
  }

  // Takes rounds of steps while they unfold facets, or are few; `suspects` are the facets that may
  // be folded, before and after.
  void take_rounds(const Stage& stage, std::vector<int32_t>& suspects) {
    size_t fewest = SIZE_MAX, idle = 0, in_vain = 0;
    const auto most = static_cast<size_t>(kIdle * static_cast<double>(c_.walls.size()));
    for (int round = 0; round < stage.rounds && idle <= most; ++round) {
      if (in_vain > std::max(most, kFewSteps)) return;
      advance(c_.progress, rounds_ / kAllRounds);
      ++rounds_;
      std::vector<int32_t> vertices = folded_vertices(suspects, stage.dented);
      if (vertices.empty()) return;
      const size_t folded = vertices.size();
      for (int ring = 0; ring < stage.rings; ++ring) vertices = with_neighbours(vertices);
      suspects = facets_round(vertices);
      std::erase_if(vertices, [&](int32_t v) { return !moves(v); });
      relax(vertices, stage);
      const double wanted = (1 - kNextToNothing) * static_cast<double>(fewest);
      idle = folded < fewest ? 0 : idle + folded;
      in_vain = static_cast<double>(folded) < wanted ? 0 : in_vain + vertices.size();
      fewest = std::min(fewest, folded);
    }
  }

  // Returns the vertices of folded facets out of some, and of dented ones if wanted, ascending.
  std::vector<int32_t> folded_vertices(std::span<const int32_t> suspects, bool dented) const {
    auto vertices = parallel_append<int32_t>(static_cast<int64_t>(suspects.size()), c_.run,
                                             [&](int64_t i, auto& out, int) {
                                               if (!can_unfold(suspects[i])) return;
                                               if (!is_folded(c_, suspects[i], dented)) return;
                                               for (const Corner& c : c_.complex.ring(suspects[i]))
                                                 out.push_back(c.vertex);
                                             });
    sort_unique(vertices);
    return vertices;
  }

  std::vector<int32_t> with_neighbours(std::span<const int32_t> vertices) const {
    std::vector<int32_t> all;
    for (const int32_t v : vertices) {
      for (const int32_t f : c_.facets_at[v]) {
        for (const Corner& c : c_.complex.ring(f)) all.push_back(c.vertex);
      }
    }
    sort_unique(all);
    return all;
  }

  // Returns the facets at some vertices, and at those that follow them.
  std::vector<int32_t> facets_round(std::span<const int32_t> vertices) const {
    std::vector<int32_t> all;
    for (const int32_t v : vertices)
      all.insert(all.end(), c_.facets_at[v].begin(), c_.facets_at[v].end());
    for (const int32_t v : c_.followers) {
      if (!std::binary_search(vertices.begin(), vertices.end(), c_.follows[v])) continue;
      all.insert(all.end(), c_.facets_at[v].begin(), c_.facets_at[v].end());
    }
    sort_unique(all);
    return all;
  }

  bool moves(int32_t v) const {
    const Placing place = c_.made.place[v];
    const bool may = place == Placing::crease || place == Placing::touching ||
                     (place == Placing::refused && !c_.is_open_rim(v));
    return may && c_.follows[v] < 0 && !c_.stays[v];
  }

  // Moves vertices towards the middle of their neighbours, and onto the walls or the crease again.
  void relax(std::span<const int32_t> vertices, const Stage& stage) {
    const auto count = static_cast<int64_t>(vertices.size());
    std::vector<Vec3> before, next(vertices.size());
    for (const int32_t v : vertices) before.push_back(c_.made.position[v]);
    for (int step = 0; step < stage.steps; ++step) {
      parallel_for(count, c_.run, [&](int64_t i) { next[i] = step_of(vertices[i]); });
      for (size_t i = 0; i < vertices.size(); ++i) c_.made.position[vertices[i]] = next[i];
    }
    std::vector<Touch> found(vertices.size());
    parallel_for(
        count, c_.run, [&](int64_t i) { found[i] = placed(vertices[i], stage); }, 64);
    for (size_t i = 0; i < vertices.size(); ++i) {
      const int32_t v = vertices[i];
      if (c_.made.place[v] == Placing::crease) {
        c_.made.position[v] = found[i].radius < 0 ? before[i] : found[i].position;
      } else if (found[i].radius > 0) {
        c_.take(v, found[i]);
        c_.made.place[v] = Placing::touching;
      } else {
        c_.made.position[v] = before[i];
      }
    }
    follow(c_);
  }

  // Returns a place half way to the middle of the neighbours of a vertex.
  Vec3 step_of(int32_t v) const {
    const Vec3& here = c_.made.position[v];
    const auto middle = middle_of_neighbours(v, c_.made.place[v]);
    return middle ? 0.5 * here + 0.5 * *middle : here;
  }

  // Returns the place on the walls, or on the crease, that is nearest to where a vertex has moved
  // to; on a crease with radius 0, or below 0 if there is none.
  Touch placed(int32_t v, const Stage& stage) const {
    const Vec3& here = c_.made.position[v];
    if (stage.nearly && c_.made.place[v] != Placing::crease && c_.walls[v].count < 3) {
      const Touch found = nearly_placed(v, here);
      if (found.radius > 0) return found;
    }
    if (c_.made.place[v] == Placing::touching) return touch(c_, v, c_.walls[v], here);
    if (c_.made.place[v] == Placing::refused) {
      const int32_t other = placed_neighbour(c_, v);
      return other < 0 ? Touch{} : touch(c_, v, c_.walls[other], here);
    }
    const auto on_crease = c_.samples.creases().nearer(here, c_.spacing_at(v));
    return on_crease ? Touch{on_crease->point} : Touch{here, -1};
  }

  // Returns the nearest place where a ball nearly touches two walls of a vertex, or of one beside
  // it.
  Touch nearly_placed(int32_t v, const Vec3& here) const {
    Touch best;
    double within = kAside * c_.spacing_at(v);
    std::vector<Walls> tried;  // the same walls again would give the same ball
    const auto take = [&](const Walls& walls) {
      if (walls.count != 2) return;
      if (std::find(tried.begin(), tried.end(), walls) != tried.end()) return;
      tried.push_back(walls);
      const Touch found = nearly_empty_ball(c_.samples, c_.spacing_at(v), walls, here, within);
      if (!(found.radius > 0)) return;
      best = found;
      within = distance(found.position, here);
    };
    take(c_.walls[v]);
    c_.for_edges(v, [&](const Corner&, int32_t other) { take(c_.walls[other]); });
    return best;
  }

  // A vertex on a crease has its neighbours on the rim, one of three walls those on the seam.
  std::optional<Vec3> middle_of_neighbours(int32_t v, Placing place) const {
    Vec3 sum;
    int count = 0;
    const auto take = [&](const Corner& c, int32_t other) {
      const int uses = c_.edge_uses[c.edge];
      const bool along = place == Placing::crease ? uses == 1 : c_.walls[v].count < 3 || uses == 3;
      if (!along) return;
      sum = sum + c_.made.position[other];
      ++count;
    };
    c_.for_edges(v, take);
    if (count == 0) return {};
    return (1.0 / count) * sum;
  }

  CrispState& c_;
  double rounds_ = 0;
};

// Returns the corners of a facet as they are drawn: in the plane between its two generators.
std::vector<FlatPoint> drawn(const CrispState& state, int32_t facet) {
  const auto ring = state.complex.ring(facet);
  const auto& [p, q] = state.complex.generators[facet];
  const auto [right, up] = across(normalized(state.samples.point(q) - state.samples.point(p)));
  std::vector<FlatPoint> corners;
  const Vec3& origin = state.made.position[ring[0].vertex];
  for (const Corner& c : ring) {
    const Vec3 at = state.made.position[c.vertex] - origin;
    corners.push_back({dot(at, right), dot(at, up)});
  }
  return corners;
}

}  // namespace

bool is_folded(const CrispState& state, int32_t facet, bool dented) {
  const std::vector<FlatPoint> corners = drawn(state, facet);
  return is_turned_over(corners) || turns_back(corners) || crosses_itself(corners) ||
         (dented && has_dent(corners, kDeepDent));
}

bool has_area(const CrispState& state, int32_t facet) { return !is_on_line(drawn(state, facet)); }

void unfold(CrispState& state) { Unfolder(state).unfold(); }

}  // namespace medial
