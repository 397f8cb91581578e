// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/crisp_parts.h"

namespace medial {
namespace {

class WallFinder {
 public:
  explicit WallFinder(const CrispState& state) : c_(state) {}

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

}  // namespace

Walls walls_at(const CrispState& state, int32_t v, bool thorough) {
  return WallFinder(state).walls_at(v, thorough);
}

Touch touch(const CrispState& state, int32_t v, const Walls& walls, const Vec3& start,
            size_t most) {
  return empty_ball(state.samples, {state.complex.position[v], state.spacing_at(v)}, walls, start,
                    most);
}

}  // namespace medial
