// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/fringe.h"

#include "base/atomic.h"

namespace medial {
namespace {

constexpr int kLevels = 16;
constexpr uint8_t kSelected = 255;

// Gathers one list from several threads; its order does not matter.
class Gathered {
 public:
  explicit Gathered(const Run& run) : parts_(run.threads) {}

  std::vector<int32_t>& of(int worker) { return parts_[worker]; }
  // Moves everything to the end of a list.
  void pour_into(std::vector<int32_t>& list) {
    for (auto& part : parts_) {
      list.insert(list.end(), part.begin(), part.end());
      part.clear();
    }
  }

 private:
  std::vector<std::vector<int32_t>> parts_;
};

template <typename Body>
void for_all(std::span<const int32_t> ids, const Run& run, const Body& body) {
  parallel_chunks(static_cast<int64_t>(ids.size()), run,
                  [&](int64_t begin, int64_t end, int worker) {
                    for (int64_t i = begin; i < end; ++i) body(ids[i], worker);
                  });
}

// Returns whether this call is the first to claim something.
template <typename T>
bool claim(T& state, T free, T taken) {
  return shared_exchange(state, free, taken);
}

class FacetPeeler {
 public:
  FacetPeeler(const InnerComplex& complex, const FacetWeights& weight, Collapse& collapse,
              const Run& run)
      : complex_(complex),
        collapse_(collapse),
        run_{run.threads, nullptr, run.arena},
        progress_(run.progress),
        level_(array<uint8_t>(complex.dual.size(), run)),
        found_(run),
        waiting_(kLevels) {
    parallel_for(complex.facets(), run_,
                 [&](int64_t f) { level_[f] = level(weight, complex.dual[f]); });
  }

  void peel() {
    start();
    for (int now = 0; now < kLevels; ++now) {
      std::vector<int32_t> front = std::exchange(waiting_[now], {});
      while (!front.empty()) {
        throw_if_cancelled(progress_);
        front = round(front, now);
      }
    }
  }

 private:
  static uint8_t level(const FacetWeights& weight, int32_t dual) {
    if (weight.selected(dual)) return kSelected;
    return static_cast<uint8_t>(std::min(kLevels * weight(dual), kLevels - 1.0));
  }

  bool is_free(int32_t edge) const { return collapse_.facets_at[edge].count() == 1; }

  // Finds the facets that have a free edge from the start.
  void start() {
    parallel_chunks(complex_.facets(), run_, [&](int64_t begin, int64_t end, int worker) {
      for (auto f = static_cast<int32_t>(begin); f < end; ++f) {
        if (level_[f] == kSelected || collapse_.facet_gone[f]) continue;
        const auto ring = complex_.ring(f);
        if (std::any_of(ring.begin(), ring.end(), [&](Corner c) { return is_free(c.edge); })) {
          found_.of(worker).push_back(f);
        }
      }
    });
    sort_in(0);
  }

  // Puts the found facets into the list of their level, or of the present level if that is higher.
  void sort_in(int now) {
    going_.clear();
    found_.pour_into(going_);
    for (const int32_t f : going_) waiting_[std::max<int>(now, level_[f])].push_back(f);
  }

  std::vector<int32_t> round(std::span<const int32_t> front, int now) {
    going_.clear();
    for_all(front, run_, [&](int32_t f, int worker) {
      if (!claim<uint8_t>(collapse_.facet_gone[f], 0, 1)) return;
      collapse_.partner[way_out(f)] = f;
      found_.of(worker).push_back(f);
    });
    found_.pour_into(going_);
    for_all(going_, run_, [&](int32_t f, int) { take_away(f); });
    for_all(going_, run_, [&](int32_t f, int worker) { find_next(f, found_.of(worker)); });
    sort_in(now);
    return std::exchange(waiting_[now], {});
  }

  int32_t way_out(int32_t facet) const {
    int32_t best = -1;
    double smallest = HUGE_VAL;
    for (const Corner& c : complex_.ring(facet)) {
      if (!is_free(c.edge)) continue;
      const auto& [a, b] = complex_.ends[c.edge];
      const double ball = std::min(complex_.radius[a], complex_.radius[b]);
      if (best < 0 || ball < smallest || (ball == smallest && c.edge < best)) {
        best = c.edge;
        smallest = ball;
      }
    }
    return best;
  }

  void take_away(int32_t facet) {
    for (const Corner& c : complex_.ring(facet)) {
      collapse_.facets_at[c.edge].remove_shared(facet);
    }
  }

  void find_next(int32_t facet, std::vector<int32_t>& found) const {
    for (const Corner& c : complex_.ring(facet)) {
      if (!is_free(c.edge)) continue;
      const int32_t last = collapse_.facets_at[c.edge].last();
      if (level_[last] != kSelected) found.push_back(last);
    }
  }

  const InnerComplex& complex_;
  Collapse& collapse_;
  Run run_;
  Progress* progress_;
  Array<uint8_t> level_;
  Gathered found_;
  std::vector<std::vector<int32_t>> waiting_;  // per level: facets
  std::vector<int32_t> going_;
};

class WirePeeler {
 public:
  WirePeeler(const InnerComplex& complex, Collapse& collapse, const Run& run)
      : complex_(complex),
        collapse_(collapse),
        run_{run.threads, nullptr, run.arena},
        progress_(run.progress),
        left_(edges_left(complex, collapse, run_)),
        found_(run) {}

  void peel() {
    std::vector<int32_t> front;
    parallel_chunks(complex_.vertices(), run_, [&](int64_t begin, int64_t end, int worker) {
      for (auto v = static_cast<int32_t>(begin); v < end; ++v) {
        if (is_loose(v)) found_.of(worker).push_back(v);
      }
    });
    found_.pour_into(front);
    while (!front.empty()) {
      throw_if_cancelled(progress_);
      round(front);
    }
  }

 private:
  bool is_loose(int32_t vertex) const {
    if (left_[vertex].count() != 1) return false;
    const int32_t edge = left_[vertex].last();
    return collapse_.is_wire(edge) && (collapse_.selected.empty() || !collapse_.selected[edge]);
  }
  // Returns whether a loose end is removed. If both ends of a wire are loose, the lower one stays.
  bool goes(int32_t vertex) const {
    const int32_t other = other_end(complex_, left_[vertex].last(), vertex);
    return left_[other].count() != 1 || other < vertex;
  }

  void round(std::vector<int32_t>& front) {
    for_all(front, run_, [&](int32_t v, int worker) {
      const int32_t edge = left_[v].last();
      if (!goes(v) || !claim(collapse_.edge_of_vertex[v], -1, edge)) return;
      collapse_.partner[edge] = with_vertex(v);
      found_.of(worker).push_back(v);
    });
    std::vector<int32_t> going;
    found_.pour_into(going);
    for_all(going, run_, [&](int32_t v, int) { take_away(v); });
    for_all(going, run_, [&](int32_t v, int worker) {
      const int32_t other = other_end(complex_, collapse_.edge_of_vertex[v], v);
      if (is_loose(other)) found_.of(worker).push_back(other);
    });
    front.clear();
    found_.pour_into(front);
  }

  void take_away(int32_t vertex) {
    const int32_t edge = collapse_.edge_of_vertex[vertex];
    for (const int32_t v : complex_.ends[edge]) left_[v].remove_shared(edge);
  }

  const InnerComplex& complex_;
  Collapse& collapse_;
  Run run_;
  Progress* progress_;
  Array<Incident> left_;  // per vertex: the edges that are left at it
  Gathered found_;
};

}  // namespace

void peel_facets(const InnerComplex& complex, const FacetWeights& weight, Collapse& collapse,
                 const Run& run) {
  FacetPeeler(complex, weight, collapse, run).peel();
}

void peel_wires(const InnerComplex& complex, Collapse& collapse, const Run& run) {
  WirePeeler(complex, collapse, run).peel();
}

}  // namespace medial
