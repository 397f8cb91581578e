#include "tight_cocone.h"

#include "union_find.h"

namespace medial {
namespace {

// On which side of the surface a cell lies, as one of its corners sees it.
enum class Face : uint8_t { none, front, back };

// What the manifold extraction says near every sample.
struct Sheets {
  std::vector<uint8_t> good;              // per sample: the surface is one disc round it
  std::vector<std::array<Face, 4>> face;  // per cell and good corner
  std::vector<int32_t> patch;  // per good sample: lowest of those that the surface connects with it
  std::vector<uint8_t> opaque;  // per cell without good corners: its smallest facets, a bit each
  std::vector<uint8_t> open;    // per patch, by its lowest sample: a corner of it is not good
};

class Marking {
 public:
  Marking(const Triangulation& t, const Csr<int32_t>& incident, const FacetSet& front,
          const FacetSet& surface)
      : t_(t), incident_(incident), front_(front), surface_(surface) {}

  bool is_good(int32_t p) {
    facets_.clear();
    for_facets_at(p, t_, incident_[p], front_, [&](const Facet& f) { facets_.push_back(f); });
    return is_one_disc(t_, facets_, p, links_);
  }

  // Floods the cells at the good sample p, of which is_good was asked last, from the front of its
  // umbrella; the others lie behind it.
  void split(int32_t p, std::vector<std::array<Face, 4>>& face) {
    queue_.clear();
    const auto reach = [&](int32_t cell) {
      Face& f = face[cell][slot_of(t_.cells[cell], p)];
      if (f == Face::front) return;
      f = Face::front;
      queue_.push_back(cell);
    };
    for (const Facet& f : facets_) reach(f.cell);
    while (!queue_.empty()) {
      const int32_t cell = queue_.back();
      queue_.pop_back();
      for (int i = 0; i < 4; ++i) {
        if (t_.cells[cell][i] != p && !surface_.has({cell, i})) reach(t_.neighbors[cell][i]);
      }
    }
    for (const int32_t cell : incident_[p]) {
      Face& f = face[cell][slot_of(t_.cells[cell], p)];
      if (f == Face::none) f = Face::back;
    }
  }

 private:
  const Triangulation& t_;
  const Csr<int32_t>& incident_;
  const FacetSet& front_;
  const FacetSet& surface_;
  std::vector<Facet> facets_;  // at a sample, seen from the front
  std::vector<Edge> links_;
  std::vector<int32_t> queue_;
};

void find_patches(const Triangulation& t, const FacetSet& front, Sheets& sheets) {
  UnionFind patches(sheets.good.size());
  const auto& good = sheets.good;
  for_facets(t, front, [&](const Facet& f) {
    const auto [i, j, k] = corners(t, f);
    if (good[i] && good[j]) patches.unite(i, j);
    if (good[j] && good[k]) patches.unite(j, k);
    if (good[k] && good[i]) patches.unite(k, i);
  });
  sheets.patch = std::move(patches).representatives();
  sheets.open.assign(good.size(), 0);
  for_facets(t, front, [&](const Facet& f) {
    const auto ids = corners(t, f);
    for (const int32_t p : ids) {
      if (good[ids[0]] && good[ids[1]] && good[ids[2]]) break;
      if (good[p]) sheets.open[sheets.patch[p]] = 1;
    }
  });
}

double squared_circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  return squared_length(u) * squared_length(v) * squared_length(c - b) /
         squared_length(cross(u, v));
}

// The facets of least circumradius, a bit each: more than one where single precision, in which most
// points are stored, cannot tell them apart.
uint8_t smallest_facets(std::span<const Vec3> points, const Triangulation& t, int32_t cell) {
  constexpr double kTie = 1 + 0x1p-20;
  std::array<double, 4> size;
  for (int i = 0; i < 4; ++i) {
    const auto [p, q, r] = corners(t, {cell, i});
    size[i] = squared_circumradius(points[p], points[q], points[r]);
  }
  const double least = *std::min_element(size.begin(), size.end());
  uint8_t smallest = 0;
  for (int i = 0; i < 4; ++i) smallest |= static_cast<uint8_t>((size[i] <= kTie * least) << i);
  return smallest;
}

Sheets mark(std::span<const Vec3> points, const Triangulation& t, const Csr<int32_t>& incident,
            const FacetSet& front, const Run& run) {
  const FacetSet surface = from_both_sides(t, front, run);
  Sheets sheets;
  sheets.good.resize(static_cast<size_t>(incident.size()));
  sheets.face.resize(t.cells.size());
  parallel_chunks(incident.size(), run, [&](int64_t begin, int64_t end, int) {
    Marking marking(t, incident, front, surface);
    for (auto p = static_cast<int32_t>(begin); p < end; ++p) {
      sheets.good[p] = marking.is_good(p);
      if (sheets.good[p]) marking.split(p, sheets.face);
    }
  });
  sheets.opaque.assign(t.cells.size(), 0);
  parallel_for(t.finite_cells, run, [&](int64_t c) {
    if (sheets.face[c] != std::array<Face, 4>{}) return;
    sheets.opaque[c] = smallest_facets(points, t, static_cast<int32_t>(c));
  });
  find_patches(t, front, sheets);
  return sheets;
}

// Takes cells away from the hull inwards, until what is left is bounded by the surface.
class Peeling {
 public:
  Peeling(std::span<const Vec3> points, const Triangulation& t, const Sheets& sheets)
      : points_(points),
        t_(t),
        sheets_(sheets),
        outside_(t.cells.size(), 0),
        outer_face_(sheets.good.size(), Face::none) {}

  void run(const Progress* progress) {
    const auto samples = static_cast<int32_t>(sheets_.good.size());
    for (int32_t cell = 0; cell < t_.cell_count(); ++cell) {
      const Cell& ids = t_.cells[cell];
      if (std::any_of(ids.begin(), ids.end(), [&](int32_t p) { return p < 0 || p >= samples; })) {
        take(cell);
      }
    }
    peel(progress);
    // Outliers may hide the surface from outside: through them, too.
    through_ = true;
    peel(progress);
  }

  CellSides sides() const {
    CellSides sides(outside_.size());
    for (size_t c = 0; c < sides.size(); ++c) {
      sides[c] = static_cast<uint8_t>(outside_[c] ? Side::outer : Side::inner);
    }
    return sides;
  }
  int64_t unreached_closed_patches() const {
    int64_t count = 0;
    for (size_t p = 0; p < sheets_.good.size(); ++p) {
      const bool first = sheets_.good[p] && sheets_.patch[p] == static_cast<int32_t>(p);
      count += first && !sheets_.open[p] && outer_face_[p] == Face::none;
    }
    return count;
  }

 private:
  // Its good corners learn from it where outside is.
  void take(int32_t cell) {
    outside_[cell] = 1;
    stack_.push_back(cell);
    for (int i = 0; i < 4; ++i) {
      const Face face = sheets_.face[cell][i];
      if (face == Face::none) continue;
      Face& outer = outer_face_[sheets_.patch[t_.cells[cell][i]]];
      if (outer != Face::none) continue;
      outer = face;
      news_ = true;
    }
  }

  void peel(const Progress* progress) {
    do {
      news_ = false;
      std::vector<Facet> again;
      std::swap(again, waiting_);
      for (const Facet& f : again) reach(f);
      while (!stack_.empty()) {
        if (++steps_ % kBatch == 0) throw_if_cancelled(progress);
        const int32_t cell = stack_.back();
        stack_.pop_back();
        for (int i = 0; i < 4; ++i) reach({cell, i});
      }
    } while (news_);
  }

  // Passes a facet, seen from outside, when that is allowed.
  void reach(const Facet& f) {
    const int32_t next = t_.neighbors[f.cell][f.slot];
    if (outside_[next]) return;
    const Verdict verdict = judge(next, f);
    if (verdict.outside) {
      take(next);
    } else if (verdict.may_change) {
      waiting_.push_back(f);
    }
  }

  struct Verdict {
    bool outside;
    bool may_change;  // when more of the surface is oriented
  };

  // The oriented corners vote. Without any the cell is transparent but for its smallest facets.
  Verdict judge(int32_t cell, const Facet& entrance) const {
    int votes = 0, voters = 0, undecided = 0;
    for (int i = 0; i < 4; ++i) {
      const Face face = sheets_.face[cell][i];
      if (face == Face::none) continue;
      const Face outer = outer_face_[sheets_.patch[t_.cells[cell][i]]];
      if (outer == Face::none) {
        ++undecided;
      } else {
        ++voters;
        votes += face == outer ? 1 : -1;
      }
    }
    if (voters > 0) return {votes > 0, undecided > 0};
    if (undecided > 0 && !through_) return {false, true};
    const uint8_t opaque =
        undecided > 0 ? smallest_facets(points_, t_, cell) : sheets_.opaque[cell];
    return {!(opaque >> mirror(t_, entrance).slot & 1), undecided > 0};
  }

  std::span<const Vec3> points_;
  const Triangulation& t_;
  const Sheets& sheets_;
  std::vector<uint8_t> outside_;
  std::vector<Face> outer_face_;  // per patch, by its lowest sample
  std::vector<int32_t> stack_;
  std::vector<Facet> waiting_;  // seen from outside
  static constexpr int64_t kBatch = 1 << 16;
  int64_t steps_ = 0;
  bool through_ = false, news_ = false;
};

}  // namespace

TightCocone tight_cocone(std::span<const Vec3> points, const Triangulation& t,
                         const Voronoi& voronoi, const Csr<int32_t>& incident, const Poles& poles,
                         const CoconeOptions& options, const Run& run) {
  Cocone c = cocone(points, t, voronoi, incident, poles, options, run);
  TightCocone result;
  result.flat = c.flat;
  const FacetSet front = manifold(points, t, incident, std::move(c), options, run);
  begin_stage(run.progress, "Marking", 0.95, 0.97);
  Sheets sheets = mark(points, t, incident, front, run);
  begin_stage(run.progress, "Peeling", 0.97, 0.99);
  Peeling peeling(points, t, sheets);
  peeling.run(run.progress);
  result.sides = peeling.sides();
  result.cavities = peeling.unreached_closed_patches();
  result.good = std::move(sheets.good);
  return result;
}

}  // namespace medial
