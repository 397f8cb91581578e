// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/flat_polygon.h"
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

constexpr int kRounds = 24;         // of steps that unfold facets
constexpr int kOwnRounds = 3;       // of these, the rounds without the neighbours
constexpr int kDentRounds = 6;      // of these, the rounds that mend deep dents, too
constexpr double kDeepDent = 0.25;  // the sine of the turn

class Unfolder {
 public:
  explicit Unfolder(CrispState& state) : c_(state) {}

  void unfold() {
    std::vector<int32_t> suspects = c_.facets;
    for (int round = 0; round < kRounds; ++round) {
      throw_if_cancelled(c_.progress);
      std::vector<int32_t> vertices = folded_vertices(suspects, round < kDentRounds);
      if (vertices.empty()) return;
      if (round >= kOwnRounds) vertices = with_neighbours(vertices);
      suspects = facets_round(vertices);
      std::vector<Touch> found(vertices.size());
      parallel_for(
          static_cast<int64_t>(vertices.size()), c_.run,
          [&](int64_t i) { found[i] = step_of(vertices[i]); }, 64);
      for (size_t i = 0; i < vertices.size(); ++i) {
        const int32_t v = vertices[i];
        if (c_.made.place[v] == Placing::crease) {
          c_.made.position[v] = found[i].position;
        } else if (found[i].radius > 0) {
          c_.take(v, found[i]);
        }
      }
      follow(c_);
    }
  }

 private:
  // Returns the vertices of folded facets out of some, and of dented ones if wanted, ascending.
  std::vector<int32_t> folded_vertices(std::span<const int32_t> suspects, bool dented) const {
    auto vertices = parallel_append<int32_t>(static_cast<int64_t>(suspects.size()), c_.run,
                                             [&](int64_t i, auto& out, int) {
                                               if (!is_folded(suspects[i], dented)) return;
                                               for (const Corner& c : c_.complex.ring(suspects[i]))
                                                 out.push_back(c.vertex);
                                             });
    sort_out(vertices);
    return vertices;
  }

  std::vector<int32_t> with_neighbours(std::span<const int32_t> vertices) const {
    std::vector<int32_t> all;
    for (const int32_t v : vertices) {
      for (const int32_t f : c_.facets_at[v]) {
        for (const Corner& c : c_.complex.ring(f)) all.push_back(c.vertex);
      }
    }
    sort_out(all);
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
    sort_out(all);
    return all;
  }

  static void sort_out(std::vector<int32_t>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }

  // Returns whether a facet is turned over, or its boundary runs back or crosses itself, as seen
  // along the line between its samples; if `dented`, also whether it has a deep dent. A facet at
  // the rim of a hole has a slight one.
  bool is_folded(int32_t facet, bool dented) const {
    const auto ring = c_.complex.ring(facet);
    const auto& [p, q] = c_.complex.generators[facet];
    const auto [right, up] = across(normalized(c_.samples.point(q) - c_.samples.point(p)));
    std::vector<FlatPoint> corners;
    const Vec3& origin = c_.made.position[ring[0].vertex];
    for (const Corner& c : ring) {
      const Vec3 at = c_.made.position[c.vertex] - origin;
      corners.push_back({dot(at, right), dot(at, up)});
    }
    return is_turned_over(corners) || turns_back(corners) || crosses_itself(corners) ||
           (dented && has_dent(corners, kDeepDent));
  }

  // Returns the new place of a vertex half way to the middle of its neighbours.
  Touch step_of(int32_t v) const {
    const Vec3& here = c_.made.position[v];
    const Placing place = c_.made.place[v];
    const bool moves = place == Placing::crease || place == Placing::touching;
    if (!moves || c_.follows[v] >= 0) return {here};
    const auto middle = middle_of_neighbours(v, place);
    if (!middle) return {here};
    const Vec3 start = 0.5 * here + 0.5 * *middle;
    if (place == Placing::touching) return touch(c_, v, c_.walls[v], start);
    const auto on_crease = c_.samples.creases().nearer(start, c_.spacing_at(v));
    return {on_crease ? on_crease->point : here};
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
};

}  // namespace

void unfold(CrispState& state) { Unfolder(state).unfold(); }

}  // namespace medial
