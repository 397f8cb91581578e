#include "skeleton/drawing.h"

#include "base/union_find.h"

namespace medial {
namespace {

class Shrinker {
 public:
  Shrinker(const InnerComplex& complex, const Alive& alive, const Run& run)
      : complex_(complex), run_(run), vertices_(complex.cell.size(), run),
        edges_(complex.ends.size(), run),
        shrunk_(array<uint8_t>(complex.ends.size(), 0, run)) {
    drawing_.drawn_facet = alive.facet;
    drawing_.drawn_edge = alive.edge;
  }

  Drawing draw() && {
    shrink_edges();
    auto flat = flat_facets();
    // One that shrinks may leave another with fewer edges.
    while (std::erase_if(flat, [&](int32_t f) { return shrinks(f); }) > 0) {
      throw_if_cancelled(run_.progress);
    }
    drawing_.vertex = std::move(vertices_).representatives();
    drawing_.edge = std::move(edges_).representatives();
    parallel_for(complex_.edges(), quiet(), [&](int64_t e) {
      if (shrunk_[drawing_.edge[e]] || drawing_.edge[e] != e) drawing_.drawn_edge[e] = 0;
    });
    return std::move(drawing_);
  }

 private:
  Run quiet() const { return {run_.threads, nullptr, run_.arena}; }
  bool without_length(int32_t edge) const {
    const auto& [a, b] = complex_.ends[edge];
    return complex_.place[a] == complex_.place[b];
  }

  void shrink_edges() {
    const auto points =
        parallel_append<int32_t>(complex_.edges(), quiet(), [&](int64_t e, auto& out, int) {
          const auto edge = static_cast<int32_t>(e);
          if (drawing_.drawn_edge[e] && without_length(edge)) out.push_back(edge);
        });
    for (const int32_t edge : points) {
      const auto& [a, b] = complex_.ends[edge];
      if (vertices_.find(a) == vertices_.find(b)) continue;
      vertices_.unite(a, b);
      shrunk_[edge] = 1;
    }
  }

  // Those with an edge without length.
  std::vector<int32_t> flat_facets() const {
    return parallel_append<int32_t>(complex_.facets(), quiet(), [&](int64_t f, auto& out, int) {
      const auto facet = static_cast<int32_t>(f);
      const auto ring = complex_.ring(facet);
      if (drawing_.drawn_facet[f] && std::any_of(ring.begin(), ring.end(), [&](const Corner& c) {
            return without_length(c.edge);
          })) {
        out.push_back(facet);
      }
    });
  }

  bool shrinks(int32_t facet) {
    left_.clear();
    for (const Corner& c : complex_.ring(facet)) {
      const int32_t edge = edges_.find(c.edge);
      if (!shrunk_[edge]) left_.push_back(edge);
    }
    if (left_.size() == 1) {
      shrunk_[left_[0]] = 1;
    } else if (left_.size() == 2 && left_[0] != left_[1]) {
      edges_.unite(left_[0], left_[1]);
    } else {
      return false;
    }
    drawing_.drawn_facet[facet] = 0;
    return true;
  }

  const InnerComplex& complex_;
  Run run_;
  UnionFind vertices_, edges_;
  Array<uint8_t> shrunk_;  // per lowest edge
  Drawing drawing_;
  std::vector<int32_t> left_;  // edges of the facet in hand
};

}  // namespace

Drawing draw(const InnerComplex& complex, const Alive& alive, const Run& run) {
  return Shrinker(complex, alive, run).draw();
}

}  // namespace medial
