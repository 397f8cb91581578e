// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/bubbles.h"

#include <map>
#include <queue>

namespace medial {
namespace {

class Opener {
 public:
  Opener(const InnerComplex& complex, const FacetWeights& weight, Collapse& collapse,
         const Run& run)
      : complex_(complex), weight_(weight), collapse_(collapse), run_(run) {
    for (const int32_t p : complex.bubbles) closed_[p] = {};
    for (int32_t f = 0; f < complex.facets(); ++f) {
      for (const int32_t p : complex.generators[f]) {
        if (const auto bubble = closed_.find(p); bubble != closed_.end()) {
          bubble->second.push_back(f);
        }
      }
    }
  }

  void open_all() {
    for (const auto& [p, walls] : closed_) push_walls(walls);
    while (!queue_.empty()) {
      throw_if_cancelled(run_.progress);
      const int32_t facet = queue_.top().second;
      queue_.pop();
      if (inside(facet) == 1) open(facet);
    }
  }

 private:
  // Returns how many closed 3-cells have this facet as a wall.
  int inside(int32_t facet) const {
    const auto& [p, q] = complex_.generators[facet];
    return static_cast<int>(closed_.count(p) + closed_.count(q));
  }
  void push_walls(std::span<const int32_t> walls) {
    for (const int32_t f : walls) {
      if (inside(f) == 1) queue_.emplace(weight_(complex_.dual[f]), f);
    }
  }
  void open(int32_t facet) {
    collapse_.facet_gone[facet] = 1;
    for (const Corner& c : complex_.ring(facet)) {
      collapse_.facets_at[c.edge].remove(facet);
    }
    const auto& [p, q] = complex_.generators[facet];
    const auto bubble = closed_.find(closed_.contains(p) ? p : q);
    const std::vector<int32_t> walls = std::move(bubble->second);
    closed_.erase(bubble);
    push_walls(walls);
  }

  using Wall = std::pair<double, int32_t>;

  const InnerComplex& complex_;
  const FacetWeights& weight_;
  Collapse& collapse_;
  Run run_;
  std::map<int32_t, std::vector<int32_t>> closed_;  // closed 3-cells and their walls
  std::priority_queue<Wall, std::vector<Wall>, std::greater<>> queue_;
};

}  // namespace

void open_bubbles(const InnerComplex& complex, const FacetWeights& weight, Collapse& collapse,
                  const Run& run) {
  if (!complex.bubbles.empty()) Opener(complex, weight, collapse, run).open_all();
}

}  // namespace medial
