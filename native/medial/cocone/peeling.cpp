// SPDX-License-Identifier: GPL-3.0-or-later
#include "cocone/peeling.h"

#include <queue>
#include <tuple>

#include "delaunay/circumcentre.h"

namespace medial {
namespace {

// Returns the faces with the least circumradius, a bit each. There may be several, because most
// points are stored in single precision, which cannot distinguish all radii.
uint8_t smallest_faces(std::span<const Vec3> points, const Triangulation& t, int32_t cell) {
  constexpr double kTie = 1 + 0x1p-20;  // derived: above the rounding of a float, squared
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

// Returns for each cell its smallest faces if none of its corners knows on which side it is, else
// 0.
std::vector<uint8_t> opaque_faces(std::span<const Vec3> points, const Triangulation& t,
                                  const Marks& marks, const Run& run) {
  std::vector<uint8_t> result(t.cells.size(), 0);
  parallel_for(t.finite_cells, run, [&](int64_t c) {
    if (marks.facing[c] == std::array<Facing, 4>{}) {
      result[c] = smallest_faces(points, t, static_cast<int32_t>(c));
    }
  });
  return result;
}

// Removes cells from the hull inwards, until the surface bounds the rest. Where the surface gives
// no answer, the largest openings are passed first: the cells behind them determine where outside
// is before a small gap between noisy samples can mislead.
class Peeling {
 public:
  Peeling(std::span<const Vec3> points, const Triangulation& t, const Marks& marks, const Run& run)
      : points_(points),
        t_(t),
        marks_(marks),
        opaque_(opaque_faces(points, t, marks, run)),
        outside_(t.cells.size(), 0),
        outer_facing_(marks.good.size(), Facing::none) {}

  void run(const Progress* progress) {
    const auto samples = static_cast<int32_t>(marks_.good.size());
    for (int32_t cell = 0; cell < t_.cell_count(); ++cell) {
      const Cell& ids = t_.cells[cell];
      if (std::any_of(ids.begin(), ids.end(), [&](int32_t p) { return p < 0 || p >= samples; })) {
        take(cell);
      }
    }
    for (int64_t steps = 0; !taken_.empty() || !openings_.empty(); ++steps) {
      if (steps % (1 << 16) == 0) throw_if_cancelled(progress);
      taken_.empty() ? pass_opening() : leave_cell();
    }
  }

  CellSides sides() const {
    CellSides sides(outside_.size());
    for (size_t c = 0; c < sides.size(); ++c) {
      sides[c] = outside_[c] ? Side::outer : Side::inner;
    }
    return sides;
  }
  int64_t unreached_closed_patches() const {
    int64_t count = 0;
    for (size_t p = 0; p < marks_.good.size(); ++p) {
      count += marks_.closed[p] && marks_.patch[p] == static_cast<int32_t>(p) &&
               outer_facing_[p] == Facing::none;
    }
    return count;
  }

 private:
  // An opening is a face, seen from outside, into a cell about which the surface gives no answer.
  struct Opening {
    double size;
    CellFace face;

    bool operator<(const Opening& other) const {
      return std::tie(size, face.cell, face.slot) <
             std::tie(other.size, other.face.cell, other.face.slot);
    }
  };

  // Moves a cell outside. It shows its corners that mark it which of their sides is out.
  void take(int32_t cell) {
    outside_[cell] = 1;
    taken_.push_back(cell);
    for (int i = 0; i < 4; ++i) {
      const Facing facing = marks_.facing[cell][i];
      if (facing == Facing::none) continue;
      Facing& outer = outer_facing_[marks_.patch[t_.cells[cell][i]]];
      if (outer == Facing::none) outer = facing;
    }
  }

  void leave_cell() {
    const int32_t cell = taken_.back();
    taken_.pop_back();
    for (int i = 0; i < 4; ++i) {
      const CellFace f{cell, i};
      const int32_t next = t_.neighbors[cell][i];
      if (outside_[next]) continue;
      const int vote = vote_of(next);
      if (vote > 0) take(next);
      if (vote == 0 && !is_opaque(mirror(t_, f))) openings_.push({size_of(f), f});
    }
  }
  void pass_opening() {
    const CellFace f = openings_.top().face;
    openings_.pop();
    const int32_t next = t_.neighbors[f.cell][f.slot];
    if (!outside_[next] && vote_of(next) >= 0) take(next);
  }

  // Lets the corners that know which of their sides is out vote on a cell: 1 if most see it
  // outside, -1 otherwise, 0 if no corner knows.
  int vote_of(int32_t cell) const {
    int votes = 0, voters = 0;
    for (int i = 0; i < 4; ++i) {
      const Facing facing = marks_.facing[cell][i];
      if (facing == Facing::none) continue;
      const Facing outer = outer_facing_[marks_.patch[t_.cells[cell][i]]];
      if (outer == Facing::none) continue;
      ++voters;
      votes += facing == outer ? 1 : -1;
    }
    return voters == 0 ? 0 : votes > 0 ? 1 : -1;
  }
  // Returns whether a face blocks the flood: only the smallest faces of a cell without votes do.
  bool is_opaque(const CellFace& f) const { return opaque_[f.cell] >> f.slot & 1; }
  double size_of(const CellFace& f) const {
    const auto [p, q, r] = corners(t_, f);
    return squared_circumradius(points_[p], points_[q], points_[r]);
  }

  std::span<const Vec3> points_;
  const Triangulation& t_;
  const Marks& marks_;
  std::vector<uint8_t> opaque_;
  std::vector<uint8_t> outside_;
  std::vector<Facing> outer_facing_;  // per patch, at its lowest sample
  std::vector<int32_t> taken_;        // cells whose neighbours are still to be visited
  std::priority_queue<Opening> openings_;
};

}  // namespace

TightCocone tight_cocone(std::span<const Vec3> points, const Triangulation& t,
                         const Voronoi& voronoi, const Csr<int32_t>& incident, const Poles& poles,
                         const CoconeOptions& options, const Run& run) {
  const Cocone c = cocone(points, t, voronoi, incident, poles, options, run);
  const FaceSet front = manifold(points, t, incident, c, options, run);
  Marks marks = mark(points, t, voronoi, incident, c, front, options, run);
  begin_stage(run.progress, "Peeling", 0.97, 0.99);
  Peeling peeling(points, t, marks, run);
  peeling.run(run.progress);
  TightCocone result;
  result.sides = peeling.sides();
  result.cavities = peeling.unreached_closed_patches();
  result.flat = c.flat;
  result.good = std::move(marks.good);
  return result;
}

}  // namespace medial
