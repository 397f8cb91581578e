// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/spikes.h"

#include "base/rows.h"

namespace medial {
namespace {

constexpr double kDisc = 1.5;  // radius of the disc, in erosion thicknesses; chosen: unseen
constexpr int kEven = 4;       // rounds that even out values along the rims

Vec3 middle(const InnerComplex& complex, int32_t facet) {
  Vec3 sum;
  for (const Corner& c : complex.ring(facet)) sum = sum + complex.position[c.vertex];
  return (1 / static_cast<double>(complex.ring(facet).size())) * sum;
}

// The sheets of K1 as they go on across edges: where three or more facets meet, across the edge go
// the one that burns last and the one whose value is largest of the others; the rest are fins.
class SheetGraph {
 public:
  SheetGraph(const InnerComplex& complex, std::span<const int32_t> partner,
             std::span<const float> thickness, const Run& run)
      : complex_(complex),
        partner_(partner),
        other_(array<int32_t>(complex.ends.size(), -1, run)),
        middle_(array<Vec3>(thickness.size(), run)) {
    for (int32_t f = 0; f < complex.facets(); ++f) {
      const float own = thickness[f];
      if (own == 0) continue;
      for (const Corner& c : complex.ring(f)) {
        int32_t& best = other_[c.edge];
        if (partner[c.edge] == f) continue;
        if (best < 0 || own > thickness[best]) best = f;
      }
    }
    parallel_for(complex.facets(), run,
                 [&](int64_t f) { middle_[f] = middle(complex, static_cast<int32_t>(f)); });
  }

  const Vec3& at(int32_t facet) const { return middle_[facet]; }
  double edge_length(int32_t edge) const {
    const auto& [a, b] = complex_.ends[edge];
    return distance(complex_.position[a], complex_.position[b]);
  }

  // Calls found(facet, edge) for the neighbours of a facet.
  template <typename Found>
  void for_neighbours(int32_t facet, const Found& found) const {
    for (const Corner& c : complex_.ring(facet)) {
      const int32_t last = partner_[c.edge], other = other_[c.edge];
      if (last < 0 || other < 0) continue;
      if (facet == last) found(other, c.edge);
      if (facet == other) found(last, c.edge);
    }
  }

 private:
  const InnerComplex& complex_;
  std::span<const int32_t> partner_;
  Array<int32_t> other_;  // per edge
  Array<Vec3> middle_;
};

// Returns the means of the values of facets and their neighbours, some times over, weighted by the
// edges between them. Facets are narrow along the rims, so it is there that they share long edges.
Array<float> evened(const SheetGraph& graph, Array<float> value, const Run& run) {
  auto before = array<float>(0, run);
  for (int round = 0; round < kEven; ++round) {
    before.assign(value.begin(), value.end());
    parallel_for(static_cast<int64_t>(value.size()), run, [&](int64_t f) {
      if (!(before[f] > 0 && before[f] < HUGE_VALF)) return;
      double sum = 0, weights = 0;
      graph.for_neighbours(static_cast<int32_t>(f), [&](int32_t other, int32_t edge) {
        if (!(before[other] < HUGE_VALF)) return;
        sum += graph.edge_length(edge) * before[other];
        weights += graph.edge_length(edge);
      });
      if (weights > 0) value[f] = static_cast<float>(0.5 * before[f] + 0.5 * sum / weights);
    });
  }
  return value;
}

// Returns the facets in descending order of their values.
std::vector<int32_t> descending(std::span<const float> value) {
  std::vector<int32_t> order = all_rows(value.size());
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return value[a] != value[b] ? value[a] > value[b] : a < b;
  });
  return order;
}

// Returns the largest thickness that vouches for each facet. Facets vouch one after the other, the
// thickest first.
Array<float> vouched(const SheetGraph& graph, double diagonal, Array<float> thickness,
                     const Run& run) {
  Array<float> value(thickness.begin(), thickness.end());
  auto depth = array<float>(thickness.size(), 0, run);  // how far inside the discs before
  std::vector<int32_t> stack;
  int64_t count = 0;
  for (const int32_t centre : descending(thickness)) {
    if (thickness[centre] == 0) break;
    if (thickness[centre] == HUGE_VALF) continue;
    const double radius = kDisc * thickness[centre] * diagonal;
    // A facet that is as far inside an earlier disc is not entered: what lies behind it is, too.
    const auto enter = [&](int32_t f, int32_t) {
      const auto inside = static_cast<float>(radius - distance(graph.at(f), graph.at(centre)));
      if (inside <= depth[f]) return;
      depth[f] = inside;
      value[f] = std::max(value[f], thickness[centre]);
      stack.push_back(f);
    };
    enter(centre, -1);
    while (!stack.empty()) {
      const int32_t f = stack.back();
      stack.pop_back();
      graph.for_neighbours(f, enter);
    }
    if (++count % (1 << 12) == 0) throw_if_cancelled(run.progress);
  }
  return value;
}

// Raises the values of facets that had to wait for others.
void wait_for_facets(const InnerComplex& complex, std::span<const int32_t> partner,
                     Array<float>& value) {
  std::vector<int32_t> raised;
  for (const int32_t f : descending(value)) {
    raised.push_back(f);
    while (!raised.empty()) {
      const int32_t g = raised.back();
      raised.pop_back();
      for (const Corner& c : complex.ring(g)) {
        const int32_t last = partner[c.edge];
        if (last < 0 || value[last] >= value[g]) continue;
        value[last] = value[g];
        raised.push_back(last);
      }
    }
  }
}

// Returns for each vertex the other end of the edge that it was removed with, or -1.
Array<int32_t> next_on_wire(const InnerComplex& complex, std::span<const int32_t> partner,
                            const Run& run) {
  auto next = array<int32_t>(complex.cell.size(), -1, run);
  for (int32_t e = 0; e < complex.edges(); ++e) {
    if (partner[e] >= 0 || partner[e] == kAlone) continue;
    const int32_t vertex = with_vertex(partner[e]);
    next[vertex] = other_end(complex, e, vertex);
  }
  return next;
}

// Returns the values of the vertices; wires end at vertices that stay.
Array<float> of_vertices(const InnerComplex& complex, std::span<const int32_t> partner,
                         std::span<const float> facet, const Run& run) {
  Array<float> value(complex.cell.size(), 0.0f);
  for (int32_t f = 0; f < complex.facets(); ++f) {
    for (const Corner& c : complex.ring(f)) value[c.vertex] = std::max(value[c.vertex], facet[f]);
  }
  const auto next = next_on_wire(complex, partner, run);
  auto waits = array<int32_t>(complex.cell.size(), 0, run);
  for (const int32_t v : next) {
    if (v >= 0) ++waits[v];
  }
  for (int32_t start = 0; start < complex.vertices(); ++start) {
    for (int32_t v = start; waits[v] == 0 && next[v] >= 0; v = next[v]) {
      waits[v] = -1;
      value[next[v]] = std::max(value[next[v]], value[v]);
      if (--waits[next[v]] > 0) break;
    }
  }
  for (int32_t v = 0; v < complex.vertices(); ++v) {
    if (next[v] < 0) value[v] = HUGE_VALF;
  }
  return value;
}

}  // namespace

SpikeValues spike_values(const InnerComplex& complex, std::span<const int32_t> partner,
                         std::span<const float> thickness, const Run& run) {
  const SheetGraph graph(complex, partner, thickness, run);
  Array<float> even = evened(graph, {thickness.begin(), thickness.end()}, run);
  even = vouched(graph, complex.diagonal, std::move(even), run);
  SpikeValues values{evened(graph, std::move(even), run), {}};
  wait_for_facets(complex, partner, values.facet);
  values.vertex = of_vertices(complex, partner, values.facet, run);
  return values;
}

}  // namespace medial
