// SPDX-License-Identifier: GPL-3.0-or-later
#include "cocone/marking.h"

#include <tuple>

#include "base/portable_math.h"
#include "base/union_find.h"

namespace medial {
namespace {

Facing turned(Facing facing) {
  return facing == Facing::front  ? Facing::back
         : facing == Facing::back ? Facing::front
                                  : Facing::none;
}

// Holds the state of a thread that marks the cells at one sample after another.
class Marker {
 public:
  Marker(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
         const Csr<int32_t>& incident, const FaceSet& front, const FaceSet& surface, double sine,
         Marks& marks)
      : points_(points),
        t_(t),
        voronoi_(voronoi),
        incident_(incident),
        front_(front),
        surface_(surface),
        sine_(sine),
        marks_(marks) {}

  bool is_good(int32_t p) {
    faces_.clear();
    for_faces_at(p, t_, incident_[p], front_, [&](const CellFace& f) { faces_.push_back(f); });
    return is_one_disc(t_, faces_, p, links_);
  }

  // Floods the cells at the good sample p from the front of its umbrella; the others are behind it.
  // The last call of is_good must have been for p.
  void split_by_umbrella(int32_t p) {
    stack_.clear();
    const auto reach = [&](int32_t cell) {
      Facing& facing = at(cell, p);
      if (facing == Facing::front) return;
      facing = Facing::front;
      stack_.push_back(cell);
    };
    for (const CellFace& f : faces_) reach(f.cell);
    while (!stack_.empty()) {
      const int32_t cell = stack_.back();
      stack_.pop_back();
      for (int i = 0; i < 4; ++i) {
        if (t_.cells[cell][i] != p && !surface_.has({cell, i})) reach(t_.neighbors[cell][i]);
      }
    }
    for (const int32_t cell : incident_[p]) {
      Facing& facing = at(cell, p);
      if (facing == Facing::none) facing = Facing::back;
    }
  }

  // Marks cells on the pole's side of the tangent plane as front, and those on the other side as
  // back; cells in the cocone stay unmarked.
  void split_by_plane(int32_t p, const Vec3& normal) {
    for (const int32_t cell : incident_[p]) at(cell, p) = above_plane(cell, p, normal);
  }
  // Returns whether the pole is in front of the umbrella.
  bool faces_pole(int32_t p, const Vec3& normal) {
    int votes = 0;
    for (const int32_t cell : incident_[p]) {
      const Facing plane = above_plane(cell, p, normal);
      if (plane != Facing::none) votes += plane == at(cell, p) ? 1 : -1;
    }
    return votes >= 0;
  }

 private:
  Facing& at(int32_t cell, int32_t p) { return marks_.facing[cell][slot_of(t_.cells[cell], p)]; }
  Facing above_plane(int32_t cell, int32_t p, const Vec3& normal) const {
    const Zone zone = zone_of(towards(points_[p], t_, voronoi_, cell), normal, sine_);
    return zone == Zone::above ? Facing::front : zone == Zone::below ? Facing::back : Facing::none;
  }

  std::span<const Vec3> points_;
  const Triangulation& t_;
  const Voronoi& voronoi_;
  const Csr<int32_t>& incident_;
  const FaceSet& front_;
  const FaceSet& surface_;
  double sine_;
  Marks& marks_;
  std::vector<CellFace> faces_;  // at the current sample, seen from the front
  std::vector<Edge> links_;
  std::vector<int32_t> stack_;
};

// Holds two flat samples whose normal lines agree.
struct Agreement {
  double cosine;  // between their pole vectors
  int32_t p, q;
};

// Returns the agreements of samples that share a candidate triangle, the best first. Pairs of good
// samples are omitted, because the surface connects them.
std::vector<Agreement> agreements(const Triangulation& t, const Cocone& cocone,
                                  std::span<const uint8_t> good, double least, const Run& run) {
  auto found = parallel_append<Agreement>(t.finite_cells, run, [&](int64_t c, auto& out, int) {
    for_faces_of(static_cast<int32_t>(c), cocone.candidates, [&](const CellFace& f) {
      const Triangle ids = corners(t, f);
      for (const int32_t x : ids) {
        const auto [p, q] = link_of(ids, x);
        if (p > q || !cocone.flat[p] || !cocone.flat[q] || (good[p] && good[q])) continue;
        const double cosine = dot(cocone.normal[p], cocone.normal[q]);
        if (std::abs(cosine) >= least) out.push_back({cosine, p, q});
      }
    });
  });
  std::sort(found.begin(), found.end(), [](const Agreement& a, const Agreement& b) {
    return std::tuple(-std::abs(a.cosine), a.p, a.q) < std::tuple(-std::abs(b.cosine), b.p, b.q);
  });
  return found;
}

struct MarkingInput {
  std::span<const Vec3> points;
  const Triangulation& t;
  const Csr<int32_t>& incident;
  const Cocone& cocone;
  const FaceSet& front;

  int64_t samples() const { return incident.size(); }
};

template <typename Body>
void for_samples(const MarkingInput& s, const Marker& marker, const Run& run, const Body& body) {
  parallel_chunks(s.samples(), run, [&](int64_t begin, int64_t end, int) {
    Marker own(marker);
    for (auto p = static_cast<int32_t>(begin); p < end; ++p) body(own, p);
  });
}

void mark_cells(const MarkingInput& s, const Marker& marker, Marks& marks, const Run& run) {
  for_samples(s, marker, run, [&](Marker& own, int32_t p) {
    marks.good[p] = own.is_good(p);
    if (marks.good[p]) {
      own.split_by_umbrella(p);
    } else if (s.cocone.flat[p]) {
      own.split_by_plane(p, s.cocone.normal[p]);
    }
  });
}

// Returns for each sample whether its pole is in front of it.
std::vector<uint8_t> facing_poles(const MarkingInput& s, const Marker& marker,
                                  std::span<const Agreement> agreements, const Marks& marks,
                                  const Run& run) {
  std::vector<uint8_t> result(marks.good.size(), 1), asked(marks.good.size(), 0);
  for (const auto& [cosine, p, q] : agreements) asked[p] = asked[q] = 1;
  for_samples(s, marker, run, [&](Marker& own, int32_t p) {
    if (asked[p] && marks.good[p]) result[p] = own.faces_pole(p, s.cocone.normal[p]);
  });
  return result;
}

void unite_on_surface(const MarkingInput& s, std::span<const uint8_t> good,
                      OrientedUnionFind& patches) {
  for_faces(s.t, s.front, [&](const CellFace& f) {
    const auto [i, j, k] = corners(s.t, f);
    if (good[i] && good[j]) patches.unite(i, j, false);
    if (good[j] && good[k]) patches.unite(j, k, false);
    if (good[k] && good[i]) patches.unite(k, i, false);
  });
}

// Turns the marks of samples that are turned relative to the lowest sample of their patch.
void number_patches(const MarkingInput& s, OrientedUnionFind& patches, Marks& marks,
                    const Run& run) {
  std::vector<uint8_t> turn(marks.good.size());
  marks.patch.resize(marks.good.size());
  for (int32_t p = 0; p < static_cast<int32_t>(turn.size()); ++p) {
    const auto found = patches.find(p);
    marks.patch[p] = found.root;
    turn[p] = found.turned;
  }
  parallel_for(s.t.cell_count(), run, [&](int64_t c) {
    for (int i = 0; i < 4; ++i) {
      Facing& facing = marks.facing[c][i];
      if (facing != Facing::none && turn[s.t.cells[c][i]]) facing = turned(facing);
    }
  });
}

void find_closed(const MarkingInput& s, Marks& marks) {
  marks.closed = marks.good;
  const auto open = [&](int32_t p) { marks.closed[marks.patch[p]] = 0; };
  for (int32_t p = 0; p < s.samples(); ++p) {
    if (!marks.good[p]) open(p);
  }
  for_faces(s.t, s.front, [&](const CellFace& f) {
    const Triangle ids = corners(s.t, f);
    const bool all = std::all_of(ids.begin(), ids.end(), [&](int32_t p) { return marks.good[p]; });
    if (!all) std::for_each(ids.begin(), ids.end(), open);
  });
}

}  // namespace

Marks mark(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
           const Csr<int32_t>& incident, const Cocone& cocone, const FaceSet& front,
           const CoconeOptions& options, const Run& run) {
  begin_stage(run.progress, "Marking", 0.95, 0.97);
  const MarkingInput s{points, t, incident, cocone, front};
  Marks marks;
  marks.good.resize(cocone.flat.size());
  marks.facing.resize(t.cells.size());
  const FaceSet surface = from_both_sides(t, front, run);
  const Marker marker(points, t, voronoi, incident, front, surface,
                      portable::sin(options.cocone_angle), marks);
  mark_cells(s, marker, marks, run);
  OrientedUnionFind patches(marks.good.size());
  unite_on_surface(s, marks.good, patches);
  const auto agreeing =
      agreements(t, cocone, marks.good, portable::cos(options.flatness_angle), run);
  const auto facing = facing_poles(s, marker, agreeing, marks, run);
  for (const auto& [cosine, p, q] : agreeing) {
    patches.unite(p, q, (cosine < 0) != (facing[p] != facing[q]));
  }
  number_patches(s, patches, marks, run);
  find_closed(s, marks);
  return marks;
}

}  // namespace medial
