// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/even_creases.h"

#include "base/parallel.h"
#include "base/rows.h"
#include "base/sort_unique.h"
#include "exact/crease_reach.h"

namespace medial {

// Where a vertex of a rim goes.
struct EvenCreases::OnCrease {
  PlaceOnCrease place;
  bool at_corner = false;  // whether facets lead into creases of two directions there
};

EvenCreases::EvenCreases(EvenMesh& even, const SamplesOnFaces& samples,
                         std::span<const Edge> generators, std::span<const double> hole,
                         std::span<const double> radius, const Run& run)
    : e_(even),
      samples_(samples),
      generators_(generators),
      hole_(hole),
      radius_(radius),
      run_{run.threads, nullptr, nullptr} {
  const auto& points = samples_.faces().mesh().points;
  for (size_t p = 0; p < points.size(); ++p) {
    if (samples_.creases().is_corner(static_cast<int32_t>(p))) corners_.push_back(points[p]);
  }
  if (!corners_.empty()) tree_ = PointTree::sorted(corners_, run_);
}

void EvenCreases::hold() {
  if (samples_.creases().empty()) return;
  moves_.clear();
  std::vector<int32_t> ends = put_on_lines();
  reach_corners();
  mend();
  for (const Move& move : moves_) {
    if (e_.held[move.vertex] == kInCorner) e_.mesh.make_node(move.vertex);
    e_.mesh.for_triangles(move.vertex, [&](int32_t t) { settle_normal(e_, t); });
  }
  std::erase_if(ends, [&](int32_t v) { return e_.held[v] != kFree || held_beside(v) < 0; });
  for (const int32_t v : ends) join_line(v);
}

void EvenCreases::put(int32_t v, const Vec3& place, uint8_t held) {
  moves_.push_back({v, e_.position[v], e_.held[v]});
  e_.position[v] = place;
  e_.held[v] = held;
}

// Returns the vertices of rims that belong on creases.
std::vector<int32_t> EvenCreases::put_on_lines() {
  std::vector<OnCrease> found(e_.position.size());
  parallel_for(
      static_cast<int64_t>(found.size()), run_,
      [&](int64_t v) { found[v] = crease_of(static_cast<int32_t>(v)); }, 256);
  auto ends = rows_where(e_.mesh.vertices(), [&](int32_t v) { return found[v].place.edge >= 0; });
  for (const int32_t v : ends) {
    if (e_.held[v] == kFree) put(v, found[v].place.point, kOnLine);
    if (!found[v].at_corner || corners_.empty()) continue;
    const Neighbour nearest = tree_.nearest(e_.position[v]);
    if (nearest.distance < kCreaseBall * hole_at(v)) put(v, corners_[nearest.id], kInCorner);
  }
  return ends;
}

// Moves the nearest vertex on a crease to each corner that no vertex has reached: a node, if one is
// near.
void EvenCreases::reach_corners() {
  const auto on_crease = rows_where(e_.mesh.vertices(), [&](int32_t v) {
    return (e_.held[v] == kOnLine || e_.held[v] == kInCorner) && e_.mesh.has_triangles(v);
  });
  std::vector<int32_t> nodes(on_crease);
  std::erase_if(nodes, [&](int32_t v) { return e_.mesh.stratum(v) != Stratum::node; });
  reach_corners_from(nodes);
  reach_corners_from(on_crease);
}

void EvenCreases::reach_corners_from(std::span<const int32_t> vertices) {
  if (vertices.empty()) return;
  const auto places = rows_of(e_.position, vertices);
  const PointTree tree = PointTree::sorted(places, run_);
  for (const Vec3& corner : corners_) {
    const Neighbour nearest = tree.nearest(corner);
    const int32_t v = vertices[nearest.id];
    if (e_.held[v] == kOnLine && nearest.distance < kCornerReach * hole_at(v)) {
      put(v, corner, kInCorner);
    }
  }
}

// Mends what moves turned over: neighbours along a rim whose order on a crease is the other way
// round become one, also where one of them is a node, and of other vertices the last move is taken
// back.
void EvenCreases::mend() {
  for (bool found = true; found;) {
    found = false;
    for (auto move = moves_.rbegin(); move != moves_.rend(); ++move) {
      const int32_t v = move->vertex;
      if (e_.mesh.has_triangles(v) && keeps_sides(e_, v, e_.position[v])) continue;
      found = true;
      if (e_.mesh.has_triangles(v) && take_in_passed(v)) continue;
      move->vertex = -1;
      if (!e_.mesh.has_triangles(v) || join_line(v)) continue;
      e_.position[v] = move->place;
      e_.held[v] = move->held;
    }
    std::erase_if(moves_, [](const Move& move) { return move.vertex < 0; });
  }
}

// Where the rim of one sheet meets the middle of another, only the first one ends, and the crease
// into which the second one leads is farther on. So only triangles with an edge of a rim count.
EvenCreases::OnCrease EvenCreases::crease_of(int32_t v) const {
  OnCrease best;
  const double hole = hole_at(v);
  const bool can_go_on = e_.held[v] == kFree || e_.held[v] == kOnLine;
  if (!can_go_on || !(radius_[e_.origin[v]] < kCreaseBall * hole)) return best;
  bool ends = false;
  e_.mesh.for_triangles(v, [&](int32_t t) {
    const auto found = samples_.crease_between(generators_[e_.source[t]], e_.position[v]);
    if (!found || !(distance(found->point, e_.position[v]) < crease_reach(samples_, *found) * hole))
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

// Returns the nearer neighbour along the rim that is on a crease and into which a vertex can be
// collapsed; or -1.
int32_t EvenCreases::held_beside(int32_t v) const {
  int32_t nearest = -1;
  if (!e_.mesh.has_triangles(v) || e_.mesh.stratum(v) != Stratum::curve) return nearest;
  const auto away = [&](int32_t w) { return distance(e_.position[w], e_.position[v]); };
  for (const int32_t w : e_.mesh.along_curve(v)) {
    const bool is_nearer = nearest < 0 || away(w) < away(nearest);
    if (e_.held[w] != kFree && is_nearer && can_collapse(e_, v, w)) nearest = w;
  }
  return nearest;
}

// Makes a vertex one with a neighbour along the rim that is on a crease. Returns whether it can be.
bool EvenCreases::join_line(int32_t v) {
  const int32_t next = held_beside(v);
  if (next >= 0) collapse(e_, v, next, changed_);
  return next >= 0;
}

// Takes the neighbours along rims that a vertex has passed on its way to a corner into it, if it is
// then sound. Returns whether it is.
bool EvenCreases::take_in_passed(int32_t v) {
  if (e_.held[v] != kInCorner) return false;
  std::vector<int32_t> passed = ends_beside(v);
  std::erase_if(passed, [&](int32_t w) {
    return !is_turned_over(e_, e_.mesh.triangles_at(v, w)[0]) || !can_collapse(e_, w, v);
  });
  if (passed.empty() || !keeps_sides(e_, v, e_.position[v], passed)) return false;
  for (const int32_t w : passed) {
    if (e_.mesh.can_collapse(w, v)) collapse(e_, w, v, changed_);
  }
  return true;
}

void EvenCreases::fill_notches() {
  if (samples_.creases().empty()) return;
  for (int32_t v = 0; v < e_.mesh.vertices(); ++v) {
    if (e_.held[v] != kFree || !e_.mesh.has_triangles(v)) continue;
    for (const int32_t a : ends_beside(v)) {
      if (e_.mesh.uses(v, a) == 1) fill_notch(v, a);
    }
  }
}

// Returns the neighbours of a vertex along rims that are on creases.
std::vector<int32_t> EvenCreases::ends_beside(int32_t v) const {
  std::vector<int32_t> found;
  e_.mesh.for_corners(v, [&](int32_t other) {
    if (e_.held[other] != kFree && e_.mesh.uses(v, other) == 1) found.push_back(other);
  });
  return found;
}

bool EvenCreases::are_beside_on_line(int32_t a, int32_t b) const {
  const double apart = distance(e_.position[a], e_.position[b]);
  if (a == b || apart > kLong * std::max(e_.target[a], e_.target[b])) return false;
  return samples_.creases()
      .nearer(0.5 * (e_.position[a] + e_.position[b]), kRise * apart)
      .has_value();
}

// The rim comes back from the same vertex, or from the next one, which is then a case of the first
// kind.
void EvenCreases::fill_notch(int32_t v, int32_t a) {
  for (const int32_t b : ends_beside(v)) {
    if (are_beside_on_line(a, b) && add_triangle(e_, v, a, b)) return;
  }
  for (const int32_t other : e_.mesh.curve_neighbours(v)) {
    if (e_.held[other] != kFree || e_.mesh.uses(v, other) != 1) continue;
    for (const int32_t b : ends_beside(other)) {
      if (!are_beside_on_line(a, b) || !add_triangle(e_, v, a, other)) continue;
      fill_notch(other, a);
      return;
    }
  }
}

OntoLine onto_creases(const SamplesOnFaces* samples) {
  return [samples](const Vec3& from, double than) -> std::optional<Vec3> {
    const auto nearest = samples->creases().nearer(from, than);
    return nearest ? std::optional(nearest->point) : std::nullopt;
  };
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
