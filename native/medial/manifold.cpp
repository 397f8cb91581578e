#include "manifold.h"

namespace medial {
namespace {

struct Stage {
  std::span<const Vec3> points;
  const Triangulation& t;
  const Csr<int32_t>& incident;
  double least_cosine;  // of the oriented normals of triangles that continue each other

  // Whether the triangles (p, q, x) and (q, p, y) continue each other across the edge pq.
  bool continue_each_other(int32_t p, int32_t q, int32_t x, int32_t y) const {
    const Vec3 edge = points[q] - points[p];
    const Vec3 n = cross(edge, points[x] - points[p]), m = cross(points[y] - points[p], edge);
    return dot(n, m) >= least_cosine * length(n) * length(m);
  }
};

// The corners (p, q, x) of a facet from its corner x on.
std::array<int32_t, 3> seen_from(const Triangulation& t, const Facet& f, int corner) {
  const auto ids = corners(t, f);
  return {ids[(corner + 1) % 3], ids[(corner + 2) % 3], ids[corner]};
}

// A disc whose triangles all continue one another.
bool is_umbrella(const Stage& s, int32_t p, std::span<const Step> steps) {
  if (!is_disc(steps)) return false;
  for (size_t i = 0; i < steps.size(); ++i) {
    const size_t n = steps.size();
    const int32_t before = steps[(i + n - 1) % n].link, after = steps[(i + 1) % n].link;
    if (!s.continue_each_other(p, steps[i].link, before, after)) return false;
  }
  return true;
}

// Triangles that are part of umbrellas, from both sides.
struct Umbrellas {
  FacetSet triangles;
  std::vector<uint8_t> simple;  // per sample: all its triangles are one umbrella
};

class UmbrellaSearch {
 public:
  UmbrellaSearch(const Stage& s, const FacetSet& set, Umbrellas& result)
      : s_(s), set_(set), result_(result) {}

  // All triangles at p, if they are one umbrella.
  void find_simple(int32_t p) {
    start(p);
    if (facets_.empty()) return;
    walk_about_vertex(s_.t, set_, facets_.front(), p, steps_);
    // The other half of the facets is the back of the walk.
    result_.simple[p] = 2 * steps_.size() == facets_.size() && is_umbrella(s_, p, steps_);
    if (result_.simple[p]) insert();
  }
  // The triangles at p that are part of some umbrella.
  void find_all(int32_t p) {
    start(p);
    for (const Facet& f : facets_) {
      if (std::find(walked_.begin(), walked_.end(), f) != walked_.end()) continue;
      walk_about_vertex(s_.t, set_, f, p, steps_);
      for (const Step& step : steps_) walked_.push_back(step.facet);
      if (is_umbrella(s_, p, steps_)) insert();
    }
  }

 private:
  void start(int32_t p) {
    facets_.clear();
    walked_.clear();
    for_facets_at(p, s_.t, s_.incident[p], set_, [&](const Facet& f) { facets_.push_back(f); });
  }
  void insert() {
    for (const Step& step : steps_) {
      result_.triangles.insert_shared(step.facet);
      result_.triangles.insert_shared(mirror(s_.t, step.facet));
    }
  }

  const Stage& s_;
  const FacetSet& set_;
  Umbrellas& result_;
  std::vector<Facet> facets_, walked_;
  std::vector<Step> steps_;
};

// Calls search(search, p) for all samples.
template <typename Search>
void search_umbrellas(const Stage& s, const FacetSet& set, Umbrellas& result, const Run& run,
                      const Search& at) {
  parallel_chunks(s.incident.size(), run, [&](int64_t begin, int64_t end, int) {
    UmbrellaSearch search(s, set, result);
    for (auto p = static_cast<int32_t>(begin); p < end; ++p) {
      if (!result.simple[p]) at(search, p);
    }
  });
}

// An edge is sharp when none of its triangles continues another.
bool is_sharp(const Stage& s, const FacetSet& set, const Facet& f, int32_t p, int32_t q) {
  std::vector<int32_t> wings;
  Facet g = f;
  do {
    wings.push_back(third_corner(s.t, g, p, q));
    g = mirror(s.t, next_about_edge(s.t, set, g, p, q));
  } while (!(g == f));
  for (size_t i = 0; i < wings.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (s.continue_each_other(p, q, wings[i], wings[j])) return false;
    }
  }
  return true;
}

// Edges between samples that are not flat may bound the surface: one triangle is enough there.
bool has_sharp_edge(const Stage& s, const FacetSet& set, const Facet& f,
                    std::span<const uint8_t> flat) {
  for (int i = 0; i < 3; ++i) {
    const auto [p, q, x] = seen_from(s.t, f, i);
    if ((flat[p] || flat[q]) && is_sharp(s, set, f, p, q)) return true;
  }
  return false;
}

void append_others_at_edge(const Stage& s, const FacetSet& set, const Facet& f, int edge,
                           std::vector<Facet>& out) {
  const auto [p, q, x] = seen_from(s.t, f, edge);
  Facet g = mirror(s.t, next_about_edge(s.t, set, f, p, q));
  for (; !(g == f); g = mirror(s.t, next_about_edge(s.t, set, g, p, q))) out.push_back(g);
}

// Deletes triangles at sharp edges, and those whose edges become sharp by it, until none is left.
// Locked triangles stay.
void prune(const Stage& s, FacetSet& set, const FacetSet& locked, std::span<const uint8_t> flat,
           const Run& run) {
  auto queue = parallel_append<Facet>(s.t.finite_cells, run, [&](int64_t c, auto& found, int) {
    const auto cell = static_cast<int32_t>(c);
    for (int i = 0; i < 4; ++i) {
      const Facet f{cell, i};
      if (set.has(f) && !locked.has(f) && s.t.neighbors[cell][i] > cell) found.push_back(f);
    }
  });
  while (!queue.empty()) {
    const Facet f = queue.back();
    queue.pop_back();
    if (!set.has(f) || locked.has(f) || !has_sharp_edge(s, set, f, flat)) continue;
    for (int i = 0; i < 3; ++i) append_others_at_edge(s, set, f, i, queue);
    erase_both(s.t, set, f);
  }
}

// The walk over the surface: grows it from triangle to triangle, always on the front side. A
// candidate that conflicts with what is there is dropped.
class Walk {
 public:
  Walk(const Stage& stage, Umbrellas umbrellas)
      : s_(stage),
        candidates_(std::move(umbrellas.triangles)),
        simple_(std::move(umbrellas.simple)),
        surface_(stage.t),
        front_(stage.t) {}

  void start(const Facet& seed) {
    if (!take(seed)) return;
    for (size_t i = 0; i < queue_.size(); ++i) {
      const Facet f = queue_[i];
      for (int edge = 0; edge < 3 && front_.has(f); ++edge) cross_edge(f, edge);
    }
    queue_.clear();
  }
  FacetSet front() && { return std::move(front_); }

 private:
  // To the first candidate on the front side that continues f across an edge.
  void cross_edge(const Facet& f, int edge) {
    const auto [p, q, x] = seen_from(s_.t, f, edge);
    Facet from = f;
    for (;;) {
      const Facet g = next_about_edge(s_.t, candidates_, from, p, q);
      if (surface_.has(g)) {
        const bool one_sided = !front_.has(g) && !(g == mirror(s_.t, f));
        if (one_sided) drop(f);
        return;
      }
      const bool next =
          is_simple(p, q) || s_.continue_each_other(p, q, x, third_corner(s_.t, g, p, q));
      if (next && take(g)) return;
      if (candidates_.has(g)) from = mirror(s_.t, g);  // too sharp: look behind it
    }
  }

  // Into the surface, unless an edge would have a third triangle.
  bool take(const Facet& f) {
    if (!candidates_.has(f) || surface_.has(f)) return false;
    insert_both(s_.t, surface_, f);
    for (int edge = 0; edge < 3; ++edge) {
      if (fits(f, edge)) continue;
      drop(f);
      return false;
    }
    front_.insert(f);
    queue_.push_back(f);
    return true;
  }
  void drop(const Facet& f) {
    erase_both(s_.t, surface_, f);
    erase_both(s_.t, candidates_, f);
    front_.erase(f);
  }

  // The edge has two candidates, which continue each other.
  bool is_simple(int32_t p, int32_t q) const { return simple_[p] || simple_[q]; }
  bool fits(const Facet& f, int edge) const {
    const auto [p, q, x] = seen_from(s_.t, f, edge);
    if (is_simple(p, q)) return true;
    const Facet ahead = next_about_edge(s_.t, surface_, f, p, q), back = mirror(s_.t, f);
    return ahead == back || next_about_edge(s_.t, surface_, back, p, q) == mirror(s_.t, ahead);
  }

  const Stage& s_;
  FacetSet candidates_;  // from both sides
  std::vector<uint8_t> simple_;
  FacetSet surface_;  // from both sides
  FacetSet front_;    // from one
  std::vector<Facet> queue_;
};

}  // namespace

FacetSet manifold(std::span<const Vec3> points, const Triangulation& t,
                  const Csr<int32_t>& incident, Cocone cocone, const CoconeOptions& options,
                  const Run& run) {
  const Stage s{points, t, incident, std::cos(options.sharp_angle)};
  Umbrellas umbrellas{FacetSet(t), std::vector<uint8_t>(cocone.flat.size())};
  search_umbrellas(s, cocone.candidates, umbrellas, run,
                   [](UmbrellaSearch& search, int32_t p) { search.find_simple(p); });
  // Where all is clear already, no triangle is lost to the pruning of its neighbours.
  prune(s, cocone.candidates, FacetSet(umbrellas.triangles), cocone.flat, run);
  search_umbrellas(s, cocone.candidates, umbrellas, run, [](UmbrellaSearch& search, int32_t p) {
    search.find_simple(p);
    search.find_all(p);
  });
  Walk walk(s, std::move(umbrellas));
  for (int32_t cell = 0; cell < t.finite_cells; ++cell) {
    throw_if_cancelled(run.progress);
    for (int i = 0; i < 4; ++i) walk.start({cell, i});
  }
  return std::move(walk).front();
}

}  // namespace medial
