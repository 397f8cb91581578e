// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/shrink.h"

#include "base/rows.h"
#include "base/union_find.h"

namespace medial {
namespace {

bool without_length(const InnerComplex& complex, std::span<const int32_t> place, int32_t edge) {
  const auto& [a, b] = complex.ends[edge];
  return place[a] == place[b];
}

// A step of a facet along an edge; `turned` is true if it is against the direction of its lowest
// edge.
struct Step {
  int32_t edge;
  bool turned;
};

class Shrinker {
 public:
  // Shrinks the complex; `points` are the edges without length.
  Shrinker(const InnerComplex& complex, std::span<const int32_t> place,
           std::span<const int32_t> points, const Run& run)
      : complex_(complex),
        place_(place),
        run_(run),
        vertices_(complex.cell.size(), run),
        edges_(complex.ends.size()),
        gone_(array<uint8_t>(complex.ends.size(), 0, run)) {
    for (const int32_t edge : points) {
      const auto& [a, b] = complex_.ends[edge];
      if (vertices_.find(a) == vertices_.find(b)) continue;
      vertices_.unite(a, b);
      gone_[edge] = 1;
    }
    shrink_facets();
  }

  InnerComplex result() && {
    const auto vertex =
        number(complex_.vertices(), [&](int32_t v) { return vertices_.find(v) == v; });
    const auto edge =
        number(complex_.edges(), [&](int32_t e) { return lowest(e) == e && !gone_[e]; });
    InnerComplex result;
    result.bubbles = complex_.bubbles;
    result.diagonal = complex_.diagonal;
    for (int32_t v = 0; v < complex_.vertices(); ++v) {
      if (vertex[v] < 0) {
        result.merged.push_back({vertex[vertices_.find(v)], complex_.cell[v]});
        continue;
      }
      result.cell.push_back(complex_.cell[v]);
      result.position.push_back(complex_.position[v]);
      result.radius.push_back(complex_.radius[v]);
    }
    std::sort(result.merged.begin(), result.merged.end());
    for (int32_t e = 0; e < complex_.edges(); ++e) {
      if (edge[e] < 0) continue;
      const auto& [a, b] = complex_.ends[e];
      const auto [low, high] = std::minmax(vertex[vertices_.find(a)], vertex[vertices_.find(b)]);
      result.ends.push_back({low, high});
    }
    std::vector<uint8_t> shrunk(complex_.dual.size(), 0);
    for (const int32_t f : shrunk_) shrunk[f] = 1;
    result.offsets.push_back(0);
    for (int32_t f = 0; f < complex_.facets(); ++f) {
      if (shrunk[f]) continue;
      for (const Corner& c : complex_.ring(f)) {
        const int32_t e = lowest(c.edge);
        if (!gone_[e]) result.corners.push_back({vertex[vertices_.find(c.vertex)], edge[e]});
      }
      result.offsets.push_back(static_cast<int32_t>(result.corners.size()));
      result.generators.push_back(complex_.generators[f]);
      result.dual.push_back(complex_.dual[f]);
    }
    std::sort(shrunk_.begin(), shrunk_.end());
    for (const int32_t f : shrunk_) {
      ShrunkFacet s{complex_.generators[f], complex_.dual[f], -1,
                    vertex[vertices_.find(complex_.ring(f)[0].vertex)]};
      for (const Corner& c : complex_.ring(f)) s.edge = std::max(s.edge, edge[lowest(c.edge)]);
      result.shrunk.push_back(s);
    }
    return result;
  }

 private:
  int32_t lowest(int32_t edge) { return edges_.find(edge).root; }

  void shrink_facets() {
    auto flat = parallel_append<int32_t>(complex_.facets(), run_, [&](int64_t f, auto& out, int) {
      const auto ring = complex_.ring(static_cast<int32_t>(f));
      if (std::any_of(ring.begin(), ring.end(),
                      [&](const Corner& c) { return without_length(complex_, place_, c.edge); })) {
        out.push_back(static_cast<int32_t>(f));
      }
    });
    // A facet that shrinks may leave another one with fewer edges, so the search is repeated.
    do {
      while (std::erase_if(flat, [&](int32_t f) { return shrinks(f); }) > 0) {
        throw_if_cancelled(run_.progress);
      }
    } while (collapse_points(flat));
  }

  // Removes facets that have shrunk to a point, together with an edge that no other facet has.
  // Returns whether there was one.
  bool collapse_points(std::vector<int32_t>& flat) {
    std::vector<int32_t> points;
    for (const int32_t f : flat) {
      if (is_point(f)) points.push_back(f);
    }
    if (points.empty()) return false;
    std::vector<int32_t> uses(complex_.ends.size(), 0);
    for (const Corner& c : complex_.corners) ++uses[lowest(c.edge)];
    for (const int32_t f : shrunk_) {
      for (const Corner& c : complex_.ring(f)) --uses[lowest(c.edge)];
    }
    const size_t before = shrunk_.size();
    for (const int32_t f : points) collapse(f, uses);
    const std::vector<int32_t> gone(shrunk_.begin() + static_cast<std::ptrdiff_t>(before),
                                    shrunk_.end());
    std::erase_if(flat,
                  [&](int32_t f) { return std::find(gone.begin(), gone.end(), f) != gone.end(); });
    return !gone.empty();
  }
  bool is_point(int32_t facet) const {
    const auto ring = complex_.ring(facet);
    return std::all_of(ring.begin(), ring.end(),
                       [&](const Corner& c) { return place_[c.vertex] == place_[ring[0].vertex]; });
  }
  void collapse(int32_t facet, std::vector<int32_t>& uses) {
    const auto ring = complex_.ring(facet);
    const auto own = std::find_if(ring.begin(), ring.end(), [&](const Corner& c) {
      const int32_t edge = lowest(c.edge);
      return !gone_[edge] && uses[edge] == 1;
    });
    if (own == ring.end()) return;
    gone_[lowest(own->edge)] = 1;
    for (const Corner& c : ring) --uses[lowest(c.edge)];
    shrunk_.push_back(facet);
  }

  bool shrinks(int32_t facet) {
    walk_round(facet);
    if (left_.size() == 1) {
      gone_[left_[0].edge] = 1;
    } else if (left_.size() == 2 && left_[0].edge != left_[1].edge) {
      // The facet follows one edge there and the other one back.
      edges_.unite(left_[0].edge, left_[1].edge, left_[0].turned == left_[1].turned);
    } else {
      return false;
    }
    shrunk_.push_back(facet);
    return true;
  }

  // Finds the steps round a facet, without those that are taken back at once.
  void walk_round(int32_t facet) {
    left_.clear();
    for (const Corner& c : complex_.ring(facet)) {
      const auto [edge, turned] = edges_.find(c.edge);
      if (gone_[edge]) continue;
      const Step step{edge, turned != (complex_.ends[c.edge][0] != c.vertex)};
      if (!left_.empty() && is_back(left_.back(), step)) {
        left_.pop_back();
      } else {
        left_.push_back(step);
      }
    }
    while (left_.size() > 1 && is_back(left_.front(), left_.back())) {
      left_.erase(left_.begin());
      left_.pop_back();
    }
  }
  static bool is_back(const Step& a, const Step& b) {
    return a.edge == b.edge && a.turned != b.turned;
  }

  // Numbers the ids that are left; all others get -1.
  template <typename IsLeft>
  Array<int32_t> number(int32_t count, const IsLeft& is_left) {
    auto numbers = array<int32_t>(static_cast<size_t>(count), -1, run_);
    int32_t next = 0;
    for (int32_t id = 0; id < count; ++id) {
      if (is_left(id)) numbers[id] = next++;
    }
    return numbers;
  }

  const InnerComplex& complex_;
  std::span<const int32_t> place_;
  Run run_;
  UnionFind vertices_;
  OrientedUnionFind edges_;
  Array<uint8_t> gone_;  // per lowest edge: 1 if it shrank to a point
  std::vector<int32_t> shrunk_;
  std::vector<Step> left_;  // round the current facet
};

// Returns the edges with the ends of another one, which a merged vertex may have, but the first.
std::vector<int32_t> parallel_edges(const InnerComplex& complex) {
  std::vector<uint8_t> merged(complex.cell.size(), 0);
  for (const auto& [vertex, cell] : complex.merged) merged[vertex] = 1;
  const auto ends = [&](int32_t e) { return complex.ends[e]; };
  auto order = rows_where(complex.ends.size(), [&](int32_t e) {
    const auto& [a, b] = ends(e);
    return a != b && (merged[a] || merged[b]);
  });
  std::ranges::stable_sort(order, {}, ends);
  std::vector<int32_t> found;
  for (size_t i = 1; i < order.size(); ++i) {
    if (ends(order[i]) == ends(order[i - 1])) found.push_back(order[i]);
  }
  return found;
}

// Puts a vertex in the middle of all parallel edges but one. They would be drawn as one edge, and
// what is between them as a cavity.
void divide_parallel_edges(InnerComplex& complex) {
  const std::vector<int32_t> parallel = parallel_edges(complex);
  if (parallel.empty()) return;
  std::vector<int32_t> half(complex.ends.size(), -1);
  for (const int32_t e : parallel) {
    const auto [a, b] = complex.ends[e];
    const Vec3 &p = complex.position[a], &q = complex.position[b];
    const double square = complex.radius[a] * complex.radius[a] +
                          complex.radius[b] * complex.radius[b] - 0.5 * squared_length(q - p);
    half[e] = complex.edges();
    complex.ends[e] = {a, complex.vertices()};
    complex.ends.push_back({b, complex.vertices()});
    complex.position.push_back(0.5 * (p + q));
    complex.radius.push_back(std::sqrt(std::max(0.5 * square, 0.0)));
    complex.cell.push_back(complex.cell[a]);
  }
  const Array<Corner> before = std::exchange(complex.corners, {});
  size_t next = 0;
  for (size_t f = 1; f < complex.offsets.size(); ++f) {
    for (; next < static_cast<size_t>(complex.offsets[f]); ++next) {
      const auto [vertex, edge] = before[next];
      const bool back = vertex != complex.ends[edge][0];
      const int32_t other = half[edge];
      complex.corners.push_back({vertex, other >= 0 && back ? other : edge});
      if (other >= 0) complex.corners.push_back({complex.ends[edge][1], back ? edge : other});
    }
    complex.offsets[f] = static_cast<int32_t>(complex.corners.size());
  }
}

}  // namespace

InnerComplex shrink(InnerComplex complex, std::span<const int32_t> place, const Run& run) {
  const auto points =
      parallel_append<int32_t>(complex.edges(), run, [&](int64_t e, auto& out, int) {
        const auto edge = static_cast<int32_t>(e);
        if (without_length(complex, place, edge)) out.push_back(edge);
      });
  if (points.empty()) return complex;
  InnerComplex shrunk = Shrinker(complex, place, points, run).result();
  divide_parallel_edges(shrunk);
  return shrunk;
}

}  // namespace medial
