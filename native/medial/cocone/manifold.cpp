// SPDX-License-Identifier: GPL-3.0-or-later
#include "cocone/manifold.h"

#include "base/portable_math.h"

namespace medial {
namespace {

struct ManifoldInput {
  std::span<const Vec3> points;
  const Triangulation& t;
  const Csr<int32_t>& incident;
  double least_cosine;  // between oriented normals of triangles that continue each other

  // Returns whether the triangles (p, q, x) and (q, p, y) continue each other across the edge pq.
  bool continue_each_other(int32_t p, int32_t q, int32_t x, int32_t y) const {
    const Vec3 edge = points[q] - points[p];
    const Vec3 n = cross(edge, points[x] - points[p]), m = cross(points[y] - points[p], edge);
    return dot(n, m) >= least_cosine * length(n) * length(m);
  }
};

// Returns the corners of a face as (p, q, x), where x is the given corner.
std::array<int32_t, 3> seen_from(const Triangulation& t, const CellFace& f, int corner) {
  const auto ids = corners(t, f);
  return {ids[(corner + 1) % 3], ids[(corner + 2) % 3], ids[corner]};
}

// Returns whether the triangles at p form a disc and all continue one another.
bool is_umbrella(const ManifoldInput& s, int32_t p, std::vector<Edge>& links) {
  if (!put_in_cycle(links)) return false;
  for (size_t i = 0; i < links.size(); ++i) {
    const Edge &here = links[i], &next = links[(i + 1) % links.size()];
    if (!s.continue_each_other(p, here[1], here[0], next[1])) return false;
  }
  return true;
}

// Holds the triangles that are part of umbrellas, from both sides.
struct UmbrellaTriangles {
  FaceSet triangles;
  std::vector<uint8_t> simple;  // per sample: 1 if all its triangles form one umbrella
};

class UmbrellaSearch {
 public:
  UmbrellaSearch(const ManifoldInput& s, const FaceSet& set, UmbrellaTriangles& result)
      : s_(s), set_(set), result_(result) {}

  // Inserts all triangles at p, if they form one umbrella.
  void find_simple(int32_t p) {
    start(p);
    links_.clear();
    for (const CellFace& f : faces_) {
      if (f.cell < s_.t.neighbors[f.cell][f.slot]) links_.push_back(link_of(corners(s_.t, f), p));
    }
    result_.simple[p] = is_umbrella(s_, p, links_);
    if (!result_.simple[p]) return;
    for (const CellFace& f : faces_) result_.triangles.insert_shared(f);
  }
  // Inserts the triangles at p that are part of an umbrella.
  void find_all(int32_t p) {
    start(p);
    walked_.clear();
    for (const CellFace& f : faces_) {
      if (std::find(walked_.begin(), walked_.end(), f) != walked_.end()) continue;
      walk_about_vertex(s_.t, set_, f, p, steps_);
      links_.clear();
      for (const CellFace& g : steps_) links_.push_back(link_of(corners(s_.t, g), p));
      walked_.insert(walked_.end(), steps_.begin(), steps_.end());
      if (!is_umbrella(s_, p, links_)) continue;
      insert_walk();
      result_.simple[p] = 2 * steps_.size() == faces_.size();
      if (result_.simple[p]) return;  // the rest is its back
    }
  }

 private:
  void start(int32_t p) {
    faces_.clear();
    for_faces_at(p, s_.t, s_.incident[p], set_, [&](const CellFace& f) { faces_.push_back(f); });
  }
  void insert_walk() {
    for (const CellFace& f : steps_) {
      result_.triangles.insert_shared(f);
      result_.triangles.insert_shared(mirror(s_.t, f));
    }
  }

  const ManifoldInput& s_;
  const FaceSet& set_;
  UmbrellaTriangles& result_;
  std::vector<CellFace> faces_, walked_, steps_;
  std::vector<Edge> links_;
};

// Calls at(search, p) for all samples that are not simple yet.
template <typename Search>
void search_umbrellas(const ManifoldInput& s, const FaceSet& set, UmbrellaTriangles& result,
                      const Run& run, const Search& at) {
  parallel_chunks(s.incident.size(), run, [&](int64_t begin, int64_t end, int) {
    UmbrellaSearch search(s, set, result);
    for (auto p = static_cast<int32_t>(begin); p < end; ++p) {
      if (!result.simple[p]) at(search, p);
    }
  });
}

// Returns whether an edge is sharp: no triangle at it continues another one.
bool is_sharp(const ManifoldInput& s, const FaceSet& set, const CellFace& f, int32_t p, int32_t q) {
  const auto next = [&](const CellFace& g) {
    return mirror(s.t, next_about_edge(s.t, set, g, p, q));
  };
  for (CellFace g = next(f); !(g == f); g = next(g)) {
    for (CellFace h = f; !(h == g); h = next(h)) {
      if (s.continue_each_other(p, q, third_corner(s.t, g, p, q), third_corner(s.t, h, p, q))) {
        return false;
      }
    }
  }
  return true;
}

// Returns whether a triangle has a sharp edge. Edges between samples that are not flat do not
// count, because the surface may end there.
bool has_sharp_edge(const ManifoldInput& s, const FaceSet& set, const CellFace& f,
                    std::span<const uint8_t> flat) {
  for (int i = 0; i < 3; ++i) {
    const auto [p, q, x] = seen_from(s.t, f, i);
    if ((flat[p] || flat[q]) && is_sharp(s, set, f, p, q)) return true;
  }
  return false;
}

void append_others_at_edge(const ManifoldInput& s, const FaceSet& set, const CellFace& f, int edge,
                           std::vector<CellFace>& out) {
  const auto [p, q, x] = seen_from(s.t, f, edge);
  CellFace g = mirror(s.t, next_about_edge(s.t, set, f, p, q));
  for (; !(g == f); g = mirror(s.t, next_about_edge(s.t, set, g, p, q))) out.push_back(g);
}

// Deletes triangles at sharp edges, and those whose edges become sharp by that, until none is left.
// Locked triangles stay.
void prune(const ManifoldInput& s, FaceSet& set, const FaceSet& locked,
           std::span<const uint8_t> flat, const Run& run) {
  auto queue = parallel_append<CellFace>(s.t.finite_cells, run, [&](int64_t c, auto& found, int) {
    const auto cell = static_cast<int32_t>(c);
    for (int i = 0; i < 4; ++i) {
      const CellFace f{cell, i};
      if (set.has(f) && !locked.has(f) && s.t.neighbors[cell][i] > cell &&
          has_sharp_edge(s, set, f, flat)) {
        found.push_back(f);
      }
    }
  });
  for (int64_t tried = 0; !queue.empty(); ++tried) {
    if (tried % (1 << 15) == 0) throw_if_cancelled(run.progress);
    const CellFace f = queue.back();
    queue.pop_back();
    if (!set.has(f) || locked.has(f) || !has_sharp_edge(s, set, f, flat)) continue;
    for (int i = 0; i < 3; ++i) append_others_at_edge(s, set, f, i, queue);
    erase_both(s.t, set, f);
  }
}

// Walks over the surface and extends it from triangle to triangle, always on the front side. A
// candidate that conflicts with the surface is dropped.
class Walk {
 public:
  Walk(const ManifoldInput& input, UmbrellaTriangles umbrellas, const Progress* progress)
      : s_(input),
        progress_(progress),
        candidates_(std::move(umbrellas.triangles)),
        simple_(std::move(umbrellas.simple)),
        surface_(input.t),
        front_(input.t) {}

  // Walks from all candidates that are wanted, in the order of their cells.
  template <typename Wanted>
  void start(const Wanted& wanted) {
    for (int32_t cell = 0; cell < s_.t.cell_count(); ++cell) {
      if (cell % kBatch == 0) throw_if_cancelled(progress_);
      for_faces_of(cell, candidates_, [&](const CellFace& f) {
        if (!surface_.has(f) && wanted(f)) start_from(f);
      });
    }
  }
  FaceSet front() && { return std::move(front_); }

 private:
  void start_from(const CellFace& seed) {
    if (!take(seed)) return;
    queue_.push_back({seed, -1});
    for (size_t i = 0; i < queue_.size(); ++i) {
      if (i % static_cast<size_t>(kBatch) == 0) throw_if_cancelled(progress_);
      const auto [f, entry] = queue_[i];
      for (int edge = 0; edge < 3 && front_.has(f); ++edge) {
        if (edge != entry) cross_edge(f, edge);
      }
    }
    queue_.clear();
  }
  // Walks across an edge to the first candidate on the front side that continues f.
  void cross_edge(const CellFace& f, int edge) {
    const auto [p, q, x] = seen_from(s_.t, f, edge);
    CellFace from = f;
    for (;;) {
      const CellFace g = next_about_edge(s_.t, candidates_, from, p, q);
      if (surface_.has(g)) {
        const bool one_sided = !front_.has(g) && !(g == mirror(s_.t, f));
        if (one_sided) drop(f);
        return;
      }
      const bool next =
          is_simple(p, q) || s_.continue_each_other(p, q, x, third_corner(s_.t, g, p, q));
      if (next && take(g)) {
        queue_.push_back({g, edge_of(g, p, q)});
        return;
      }
      // too sharp, so the search continues behind it
      if (candidates_.has(g)) from = mirror(s_.t, g);
    }
  }

  int edge_of(const CellFace& f, int32_t p, int32_t q) const {
    const Triangle ids = corners(s_.t, f);
    return ids[0] != p && ids[0] != q ? 0 : ids[1] != p && ids[1] != q ? 1 : 2;
  }

  // Adds a triangle to the surface, unless this would give one of its edges a third triangle.
  bool take(const CellFace& f) {
    if (!candidates_.has(f) || surface_.has(f)) return false;
    insert_both(s_.t, surface_, f);
    for (int edge = 0; edge < 3; ++edge) {
      if (fits(f, edge)) continue;
      drop(f);
      return false;
    }
    front_.insert(f);
    return true;
  }
  void drop(const CellFace& f) {
    erase_both(s_.t, surface_, f);
    erase_both(s_.t, candidates_, f);
    front_.erase(f);
  }

  // Returns whether the edge has just two candidates, which continue each other.
  bool is_simple(int32_t p, int32_t q) const { return simple_[p] || simple_[q]; }
  bool fits(const CellFace& f, int edge) const {
    const auto [p, q, x] = seen_from(s_.t, f, edge);
    if (is_simple(p, q)) return true;
    const CellFace ahead = next_about_edge(s_.t, surface_, f, p, q), back = mirror(s_.t, f);
    return ahead == back || next_about_edge(s_.t, surface_, back, p, q) == mirror(s_.t, ahead);
  }

  static constexpr int32_t kBatch = 1 << 15;

  const ManifoldInput& s_;
  const Progress* progress_;
  FaceSet candidates_;  // from both sides
  std::vector<uint8_t> simple_;
  FaceSet surface_;  // from both sides
  FaceSet front_;    // from one side
  struct Reached {
    CellFace face;
    int entry;  // the edge by which it was reached; -1 for a seed
  };
  std::vector<Reached> queue_;
};

}  // namespace

FaceSet manifold(std::span<const Vec3> points, const Triangulation& t, const Csr<int32_t>& incident,
                 const Cocone& cocone, const CoconeOptions& options, const Run& run) {
  begin_stage(run.progress, "Manifold extraction", 0.93, 0.95);
  const ManifoldInput s{points, t, incident, portable::cos(options.sharp_angle)};
  FaceSet candidates = cocone.candidates;
  UmbrellaTriangles umbrellas{FaceSet(t), std::vector<uint8_t>(cocone.flat.size())};
  search_umbrellas(s, candidates, umbrellas, run,
                   [](UmbrellaSearch& search, int32_t p) { search.find_simple(p); });
  // Where the surface is already clear, pruning of neighbours must not delete a triangle.
  prune(s, candidates, umbrellas.triangles, cocone.flat, run);
  search_umbrellas(s, candidates, umbrellas, run,
                   [](UmbrellaSearch& search, int32_t p) { search.find_all(p); });
  Walk walk(s, std::move(umbrellas), run.progress);
  // The walk starts outside, at the hull, because in a stack of triangles the surface seen from the
  // front differs from that seen from the back.
  const auto samples = static_cast<int32_t>(incident.size());
  walk.start([&](const CellFace& f) {
    const int32_t beyond = t.cells[f.cell][f.slot];
    return beyond < 0 || beyond >= samples;
  });
  walk.start([](const CellFace&) { return true; });
  return std::move(walk).front();
}

}  // namespace medial
