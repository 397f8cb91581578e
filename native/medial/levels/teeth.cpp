// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/teeth.h"

namespace medial {
namespace {

constexpr double kTooth = 0.65;  // share of a facet's boundary that is free; chosen: unseen
constexpr int kPasses = 3;       // teeth may be several facets long

class Trimmer {
 public:
  Trimmer(const InnerComplex& complex, Alive& alive, const Run& run)
      : complex_(complex),
        alive_(alive),
        facets_at_(array<int32_t>(complex.ends.size(), 0, run)),
        edges_at_(array<int32_t>(complex.cell.size(), 0, run)) {
    for (int32_t f = 0; f < complex.facets(); ++f) {
      if (!alive.facet[f]) continue;
      for (const Corner& c : complex.ring(f)) ++facets_at_[c.edge];
    }
    for (int32_t e = 0; e < complex.edges(); ++e) {
      if (!alive.edge[e]) continue;
      for (const int32_t v : complex.ends[e]) ++edges_at_[v];
    }
  }

  // Returns whether a facet went.
  bool pass() {
    bool any = false;
    for (int32_t f = 0; f < complex_.facets(); ++f) {
      if (alive_.facet[f] && trim(f)) any = true;
    }
    return any;
  }

 private:
  bool is_free(const Corner& c) const { return facets_at_[c.edge] == 1; }
  double edge_length(const Corner& c) const {
    const auto& [a, b] = complex_.ends[c.edge];
    return distance(complex_.position[a], complex_.position[b]);
  }

  // Returns the place in the ring where the only run of free edges begins, or -1.
  static int64_t start_of_run(std::span<const Corner> ring, const auto& is_free) {
    int64_t start = -1;
    for (size_t i = 0; i < ring.size(); ++i) {
      if (!is_free(ring[i]) || is_free(ring[(i + ring.size() - 1) % ring.size()])) continue;
      if (start >= 0) return -1;
      start = static_cast<int64_t>(i);
    }
    return start;
  }

  // Removes a facet, if it is a tooth: all its free edges lie side by side, and nothing else hangs
  // on the vertices between them.
  bool trim(int32_t f) {
    const auto ring = complex_.ring(f);
    const int64_t start = start_of_run(ring, [&](const Corner& c) { return is_free(c); });
    if (start < 0) return false;
    double free = 0, all = 0;
    for (const Corner& c : ring) {
      all += edge_length(c);
      free += is_free(c) ? edge_length(c) : 0;
    }
    const auto at = [&](size_t k) { return ring[(static_cast<size_t>(start) + k) % ring.size()]; };
    size_t count = 1;
    for (; is_free(at(count)); ++count) {
      if (edges_at_[at(count).vertex] != 2) return false;
    }
    if (!(free > kTooth * all)) return false;
    alive_.facet[f] = 0;
    for (size_t k = 0; k < ring.size(); ++k) --facets_at_[at(k).edge];
    for (size_t k = 0; k < count; ++k) {
      alive_.edge[at(k).edge] = 0;
      for (const int32_t v : complex_.ends[at(k).edge]) --edges_at_[v];
      if (k > 0) alive_.vertex[at(k).vertex] = 0;
    }
    return true;
  }

  const InnerComplex& complex_;
  Alive& alive_;
  Array<int32_t> facets_at_;  // per edge: facets that are there
  Array<int32_t> edges_at_;   // per vertex: edges that are there
};

}  // namespace

void trim_teeth(const InnerComplex& complex, Alive& alive, const Run& run) {
  Trimmer trimmer(complex, alive, run);
  for (int pass = 0; pass < kPasses && trimmer.pass(); ++pass) throw_if_cancelled(run.progress);
}

}  // namespace medial
