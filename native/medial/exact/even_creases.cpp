// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/even_creases.h"

#include "base/parallel.h"
#include "base/rows.h"
#include "exact/crease_reach.h"

namespace medial {
namespace {

// Where a vertex of a rim goes.
struct OnCrease {
  PlaceOnCrease place;
  bool at_corner = false;  // whether facets lead into creases of two directions there
};

class CreaseHolder {
 public:
  CreaseHolder(EvenMesh& even, const SamplesOnFaces& samples, std::span<const Edge> generators,
               std::span<const double> hole, std::span<const double> radius)
      : e_(even), samples_(samples), generators_(generators), hole_(hole), radius_(radius) {}

  void hold(const Run& run) {
    std::vector<OnCrease> found(e_.position.size());
    parallel_for(
        static_cast<int64_t>(found.size()), {run.threads, nullptr, nullptr},
        [&](int64_t v) { found[v] = crease_of(static_cast<int32_t>(v)); }, 256);
    find_corners(run);
    for (int32_t v = 0; v < e_.mesh.vertices(); ++v) {
      if (found[v].place.edge < 0) continue;
      e_.position[v] = found[v].place.point;
      e_.held[v] = kOnLine;
      if (found[v].at_corner) take_corner(v, kCreaseBall * hole_[v]);
    }
    reach_corners(run);
    end_lines();
  }

 private:
  // Where the rim of one sheet meets the middle of another, only the first one ends, and the crease
  // into which the second one leads is farther on. So only triangles with an edge of a rim count.
  OnCrease crease_of(int32_t v) const {
    OnCrease best;
    if (!(radius_[v] < kCreaseBall * hole_[v])) return best;
    bool ends = false;
    e_.mesh.for_triangles(v, [&](int32_t t) {
      const auto found = samples_.crease_between(generators_[e_.source[t]], e_.position[v]);
      if (!found ||
          !(distance(found->point, e_.position[v]) < crease_reach(samples_, *found) * hole_[v]))
        return;
      for (const int32_t other : link_of(e_.mesh.triangle(t), v)) {
        ends = ends || e_.mesh.uses(v, other) == 1;
      }
      best.at_corner =
          best.at_corner || (best.place.edge >= 0 && !same_direction(samples_, best.place, *found));
      if (best.place.edge < 0 ||
          distance(found->point, e_.position[v]) < distance(best.place.point, e_.position[v])) {
        best.place = *found;
      }
    });
    return ends ? best : OnCrease{};
  }

  void find_corners(const Run& run) {
    const auto& points = samples_.faces().mesh().points;
    for (size_t p = 0; p < points.size(); ++p) {
      if (samples_.creases().is_corner(static_cast<int32_t>(p))) corners_.push_back(points[p]);
    }
    if (!corners_.empty()) tree_ = PointTree::sorted(corners_, {run.threads, nullptr, nullptr});
    reached_.assign(corners_.size(), 0);
  }

  void take_corner(int32_t v, double within) {
    if (corners_.empty()) return;
    const Neighbour nearest = tree_.nearest(e_.position[v]);
    if (!(nearest.distance < within)) return;
    put(v, static_cast<size_t>(nearest.id));
  }
  void put(int32_t v, size_t corner) {
    e_.position[v] = corners_[corner];
    e_.held[v] = kInCorner;
    e_.mesh.make_node(v);
    reached_[corner] = 1;
  }

  // Moves the nearest vertex on a crease to each corner that no vertex has reached.
  void reach_corners(const Run& run) {
    const auto held =
        rows_where(e_.mesh.vertices(), [&](int32_t v) { return e_.held[v] == kOnLine; });
    if (held.empty()) return;
    const auto places = rows_of(e_.position, held);
    const PointTree tree = PointTree::sorted(places, {run.threads, nullptr, nullptr});
    for (size_t c = 0; c < corners_.size(); ++c) {
      if (reached_[c]) continue;
      const Neighbour nearest = tree.nearest(corners_[c]);
      const int32_t v = held[nearest.id];
      if (e_.held[v] == kOnLine && nearest.distance < kCornerReach * hole_[v]) put(v, c);
    }
  }

  // A vertex whose neighbour along the rim is on no crease ends the line.
  void end_lines() {
    for (int32_t v = 0; v < e_.mesh.vertices(); ++v) {
      if (!e_.held[v] || e_.mesh.stratum(v) != Stratum::curve) continue;
      const auto [a, b] = e_.mesh.along_curve(v);
      if (!e_.held[a] || !e_.held[b]) e_.mesh.make_node(v);
    }
  }

  EvenMesh& e_;
  const SamplesOnFaces& samples_;
  std::span<const Edge> generators_;
  std::span<const double> hole_, radius_;
  PointTree tree_;
  std::vector<Vec3> corners_;
  std::vector<uint8_t> reached_;  // per corner
};

}  // namespace

void hold_on_creases(EvenMesh& even, const SamplesOnFaces& samples,
                     std::span<const Edge> generators, std::span<const double> hole,
                     std::span<const double> radius, const Run& run) {
  if (samples.creases().empty()) return;
  CreaseHolder(even, samples, generators, hole, radius).hold(run);
}

void unite_held(EvenMesh& even) {
  std::vector<int32_t> moved, held = rows_where(even.mesh.vertices(), [&](int32_t v) {
                                return even.held[v] != kFree && even.mesh.has_triangles(v);
                              });
  std::ranges::sort(held, {}, [&](int32_t v) {
    const auto& [x, y, z] = even.position[v];
    return std::tuple(x, y, z, even.held[v], v);
  });
  for (size_t i = 0; i < held.size(); ++i) {
    const Vec3 here = even.position[held[i]];
    for (size_t j = i + 1; j < held.size() && even.position[held[j]] == here; ++j) {
      if (!even.mesh.can_unite(held[i], held[j])) continue;
      collapse(even, held[i], held[j], moved);
      break;
    }
  }
}

}  // namespace medial
