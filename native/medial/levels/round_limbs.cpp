// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/round_limbs.h"

#include "base/rows.h"
#include "base/sort.h"
#include "base/sort_unique.h"
#include "levels/curves.h"

namespace medial {
namespace {

constexpr double kRound = 0.5;  // share of the length of a chain; chosen: unseen

// Holds wires that were each removed with a vertex, and the vertices that they lead to. All of them
// end somewhere without facets, so they are a forest, whose roots are vertices that stay.
struct Forest {
  std::vector<int32_t> edges;     // ids in the complex, ascending
  std::vector<int32_t> vertices;  // the same
  std::vector<Edge> wires;        // rows of `vertices`: from the removed vertex to the next
  std::vector<uint8_t> is_root;   // per row of `vertices`
};

int32_t row_of(const std::vector<int32_t>& ids, int32_t id) {
  return static_cast<int32_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
}

Forest dangling(const Hierarchy::Parts& h, const LevelOptions& options, const Alive& alive,
                const Run& run) {
  Forest forest;
  forest.edges = parallel_append<int32_t>(h.complex.edges(), run, [&](int64_t e, auto& out, int) {
    const int32_t partner = h.partner[e];
    if (!alive.edge[e] || partner >= 0 || partner == kAlone) return;
    if (!exceeds(h.values.vertex[with_vertex(partner)], options)) {
      out.push_back(static_cast<int32_t>(e));
    }
  });
  for (const int32_t e : forest.edges) {
    const auto& [a, b] = h.complex.ends[e];
    forest.vertices.insert(forest.vertices.end(), {a, b});
  }
  sort_unique(forest.vertices);
  forest.is_root.assign(forest.vertices.size(), 1);
  for (const int32_t e : forest.edges) {
    const int32_t v = with_vertex(h.partner[e]), next = other_end(h.complex, e, v);
    forest.wires.push_back({row_of(forest.vertices, v), row_of(forest.vertices, next)});
    forest.is_root[forest.wires.back()[0]] = 0;
  }
  return forest;
}

double round_share(const Curve& curve) {
  double all = 0, round = 0;
  for (size_t k = 1; k < curve.canal.size(); ++k) {
    const Canal &a = curve.canal[k - 1], &b = curve.canal[k];
    const double step = distance(a.centre, b.centre);
    all += step;
    round += step * 0.5 * (a.trust + b.trust);
  }
  return all > 0 ? round / all : 0;
}

// Removes chains from the loose ends of a forest.
class Shedder {
 public:
  Shedder(const Forest& forest, const std::vector<Chain>& chains, const std::vector<Curve>& curves)
      : forest_(forest), chains_(chains), curves_(curves), carried_(forest.vertices.size(), 0) {}

  // Returns the chains that are removed.
  std::vector<int32_t> shed() && {
    std::vector<int32_t> chain_from(carried_.size(), -1), gone;
    for (size_t c = 0; c < chains_.size(); ++c) {
      ++carried_[inner_end(chains_[c])];
      chain_from[outer_end(chains_[c])] = static_cast<int32_t>(c);
    }
    auto loose =
        rows_where(chains_.size(), [&](int32_t c) { return carried_[outer_end(chains_[c])] == 0; });
    while (!loose.empty()) {
      const int32_t c = loose.back(), end = inner_end(chains_[c]);
      loose.pop_back();
      if (round_share(curves_[c]) >= kRound) continue;
      gone.push_back(c);
      if (--carried_[end] == 0 && chain_from[end] >= 0) loose.push_back(chain_from[end]);
    }
    return gone;
  }

 private:
  bool leads_inwards(const Chain& chain) const {
    return forest_.wires[chain.wires[0]][0] == chain.vertices[0];
  }
  int32_t outer_end(const Chain& c) const {
    return leads_inwards(c) ? c.vertices.front() : c.vertices.back();
  }
  int32_t inner_end(const Chain& c) const {
    return leads_inwards(c) ? c.vertices.back() : c.vertices.front();
  }

  const Forest& forest_;
  const std::vector<Chain>& chains_;
  const std::vector<Curve>& curves_;
  std::vector<int32_t> carried_;  // per vertex: chains that lead to it and stay
};

}  // namespace

void shed_flat_limbs(const Hierarchy::Parts& h, const LevelOptions& options, Alive& alive,
                     const Run& run) {
  const Forest forest = dangling(h, options, alive, run);
  if (forest.edges.empty()) return;
  const auto places = rows_of(h.complex.position, forest.vertices);
  const auto chains = chains_of(forest.wires, forest.is_root);
  const auto curves = fit_curves(chains, places, *h.samples, run);
  for (const int32_t c : Shedder(forest, chains, curves).shed()) {
    for (const int32_t wire : chains[c].wires) {
      alive.edge[forest.edges[wire]] = 0;
      alive.vertex[forest.vertices[forest.wires[wire][0]]] = 0;
    }
  }
}

}  // namespace medial
