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

int32_t opposite(const Triangulation& t, const Facet& f, int32_t p, int32_t q) {
  const auto [i, j, k] = corners(t, f);
  return i != p && i != q ? i : j != p && j != q ? j : k;
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

// The triangles that are part of an umbrella at one of their corners.
FacetSet umbrella_triangles(const Stage& s, const FacetSet& set, const Run& run) {
  FacetSet result(s.t);
  std::vector<std::vector<Step>> steps_of(run.threads);
  std::vector<std::vector<Facet>> walked_of(run.threads);
  parallel_chunks(s.incident.size(), run, [&](int64_t begin, int64_t end, int worker) {
    auto& steps = steps_of[worker];
    auto& walked = walked_of[worker];
    for (auto p = static_cast<int32_t>(begin); p < end; ++p) {
      walked.clear();
      for_facets_at(p, s.t, s.incident[p], set, [&](const Facet& f) {
        if (std::find(walked.begin(), walked.end(), f) != walked.end()) return;
        walk_about_vertex(s.t, set, f, p, steps);
        for (const Step& step : steps) walked.push_back(step.facet);
        if (!is_umbrella(s, p, steps)) return;
        for (const Step& step : steps) {
          result.insert_shared(step.facet);
          result.insert_shared(mirror(s.t, step.facet));
        }
      });
    }
  });
  return result;
}

// An edge is sharp when none of its triangles continues another.
bool is_sharp(const Stage& s, const FacetSet& set, const Facet& f, int32_t p, int32_t q) {
  std::vector<int32_t> wings;
  Facet g = f;
  do {
    wings.push_back(opposite(s.t, g, p, q));
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
  Walk(const Stage& stage, FacetSet candidates)
      : s_(stage), candidates_(std::move(candidates)), surface_(stage.t), front_(stage.t) {}

  void start(const Facet& seed) {
    if (!take(seed)) return;
    for (size_t i = 0; i < queue_.size(); ++i) {
      const Facet f = queue_[i];
      for (int edge = 0; edge < 3; ++edge) cross_edge(f, edge);
    }
    queue_.clear();
  }
  FacetSet front() && { return std::move(front_); }

 private:
  // To the first candidate on the front side that continues f across an edge.
  void cross_edge(const Facet& f, int edge) {
    const auto [p, q, x] = seen_from(s_.t, f, edge);
    const Facet back = mirror(s_.t, f);
    Facet from = f;
    for (;;) {
      const Facet g = next_about_edge(s_.t, candidates_, from, p, q);
      if (g == back || surface_.has(g)) return;
      if (s_.continue_each_other(p, q, x, opposite(s_.t, g, p, q)) && take(g)) return;
      if (candidates_.has(g)) from = mirror(s_.t, g);  // too sharp: look behind it
    }
  }

  // Into the surface, unless an edge would have a third triangle or one that faces the other way.
  bool take(const Facet& f) {
    if (!candidates_.has(f) || surface_.has(f)) return false;
    insert_both(s_.t, surface_, f);
    for (int edge = 0; edge < 3; ++edge) {
      if (fits(f, edge)) continue;
      erase_both(s_.t, surface_, f);
      erase_both(s_.t, candidates_, f);
      return false;
    }
    front_.insert(f);
    queue_.push_back(f);
    return true;
  }
  bool fits(const Facet& f, int edge) const {
    const auto [p, q, x] = seen_from(s_.t, f, edge);
    const Facet back = mirror(s_.t, f), g = next_about_edge(s_.t, surface_, f, p, q);
    if (g == back) return true;
    return front_.has(g) && next_about_edge(s_.t, surface_, back, p, q) == mirror(s_.t, g);
  }

  const Stage& s_;
  FacetSet candidates_, surface_;  // from both sides
  FacetSet front_;                 // from one
  std::vector<Facet> queue_;
};

}  // namespace

FacetSet manifold(std::span<const Vec3> points, const Triangulation& t,
                  const Csr<int32_t>& incident, Cocone cocone, const CoconeOptions& options,
                  const Run& run) {
  const Stage s{points, t, incident, std::cos(options.sharp_angle)};
  const FacetSet locked = umbrella_triangles(s, cocone.candidates, run);
  prune(s, cocone.candidates, locked, cocone.flat, run);
  Walk walk(s, umbrella_triangles(s, cocone.candidates, run));
  for (int32_t cell = 0; cell < t.finite_cells; ++cell) {
    throw_if_cancelled(run.progress);
    for (int i = 0; i < 4; ++i) walk.start({cell, i});
  }
  return std::move(walk).front();
}

}  // namespace medial
