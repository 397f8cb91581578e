// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.h"

namespace medial {
namespace {

constexpr int kCurveSteps = 3;  // towards the middle of the neighbours along a curve
constexpr double kStep = 0.5;   // of the way to there, which levels a zigzag at once; chosen: axis
// A step back, a little longer, keeps lines from shrinking where they bend (Taubin 1995).
constexpr double kStepBack = -0.53;  // derived: 1 / (0.113 - 1 / kStep)

using Ranked = std::tuple<double, int32_t, int32_t>;  // an edge, by what comes first

// Returns the edges that have a rank, in its order; HUGE_VAL is no rank.
template <typename RankOf>
std::vector<Ranked> ranked_edges(const SheetComplex& mesh, const RankOf& rank_of) {
  std::vector<Ranked> ranked;
  for (const auto& [a, b] : mesh.edges()) {
    const double rank = rank_of(a, b);
    if (rank < HUGE_VAL) ranked.emplace_back(rank, a, b);
  }
  std::sort(ranked.begin(), ranked.end());
  return ranked;
}

// Collapses edges until none can be, in passes. collapse(from, to) returns whether it did so.
template <typename RankOf, typename Collapse>
void collapse_all(const SheetComplex& mesh, const RankOf& rank_of, const Collapse& collapse) {
  for (bool found = true; found;) {
    found = false;
    for (const auto& [rank, a, b] : ranked_edges(mesh, rank_of)) {
      if (!mesh.has_triangles(a) || !mesh.has_triangles(b)) continue;
      found = collapse(a, b) || collapse(b, a) || found;
    }
  }
}

class Remesher {
 public:
  Remesher(EvenMesh& even, const RemeshOptions& options, const Run& run)
      : e_(even), mesh_(even.mesh), options_(options), run_(run) {}

  // Splits the edges that are too long, the longest first.
  void split() {
    const auto rank_of = [&](int32_t a, int32_t b) {
      const double share = share_of_target(a, b);
      return share > kLong || misses_line(a, b) ? -share : HUGE_VAL;
    };
    for (const auto& [rank, a, b] : ranked_edges(mesh_, rank_of)) {
      throw_if_cancelled(run_.progress);
      if (!is_still(a, b)) split(a, b);
    }
  }

  void collapse() {
    throw_if_cancelled(run_.progress);
    const auto rank_of = [&](int32_t a, int32_t b) {
      const double share = share_of_target(a, b);
      return share < kShort ? share : HUGE_VAL;
    };
    collapse_all(mesh_, rank_of, [&](int32_t from, int32_t to) { return collapse(from, to); });
  }

  void flip() {
    for (const auto& [a, b] : mesh_.edges()) {
      if (!is_still(a, b) && is_skew(a, b) && mesh_.can_flip(a, b)) flip_if_flat(a, b);
    }
  }

  void smooth() {
    find_places();
    if (options_.moves_curves) {
      for (int i = 0; i < kCurveSteps; ++i) {
        step(Stratum::node, kStep);
        step(Stratum::curve, kStep);
        step(Stratum::curve, kStepBack);
      }
    } else {
      step(Stratum::curve, kStep);
    }
    step(Stratum::sheet, 1);
  }

 private:
  // A vertex, and on a curve its neighbours along it.
  struct Place {
    int32_t vertex;
    Edge along;
  };

  double share_of_target(int32_t a, int32_t b) const {
    return distance(e_.position[a], e_.position[b]) / target(a, b);
  }
  bool is_still(int32_t a, int32_t b) const { return e_.held[a] == kStill && e_.held[b] == kStill; }
  bool is_on_line(int32_t v) const { return e_.held[v] == kOnLine || e_.held[v] == kInCorner; }
  double target(int32_t a, int32_t b) const { return 0.5 * (e_.target[a] + e_.target[b]); }

  void split(int32_t a, int32_t b) {
    const std::vector<int32_t> halves = mesh_.triangles_at(a, b);
    const Vec3 middle = 0.5 * (e_.position[a] + e_.position[b]);
    const std::optional<Vec3> on_line = place_on_line(a, b, middle);
    mesh_.split(a, b, split_off_);
    e_.position.push_back(on_line.value_or(middle));
    e_.target.push_back(target(a, b));
    e_.origin.push_back(e_.origin[a]);
    e_.held.push_back(on_line ? kOnLine : kFree);
    for (const int32_t t : halves) {
      e_.source.push_back(e_.source[t]);
      e_.normal.push_back(e_.normal[t]);
    }
  }

  // Returns the place of the middle of an edge along a line. There is none where a rim passes from
  // one line to another.
  std::optional<Vec3> place_on_line(int32_t a, int32_t b, const Vec3& middle) const {
    if (!is_on_line(a) || !is_on_line(b) || mesh_.is_inside_sheet(a, b)) return {};
    return options_.onto_line(middle, kRise * distance(e_.position[a], e_.position[b]));
  }

  // Returns whether an edge along a line misses it by more than it may.
  bool misses_line(int32_t a, int32_t b) const {
    const Vec3 middle = 0.5 * (e_.position[a] + e_.position[b]);
    const std::optional<Vec3> place = place_on_line(a, b, middle);
    return place && distance(*place, middle) > options_.chord;
  }

  bool collapse(int32_t from, int32_t to) {
    const bool can = keeps_line(from, to) && stays_short(from, to) && can_collapse(e_, from, to);
    if (can) medial::collapse(e_, from, to, moved_);
    return can;
  }

  // Returns whether no edge at the vertex gets too long.
  bool stays_short(int32_t from, int32_t to) const {
    bool all = true;
    mesh_.for_corners(from, [&](int32_t other) {
      all = all && (other == to || share_of_target(other, to) < kLong);
    });
    return all;
  }

  // Returns whether a curve goes on along its line on both sides of a held vertex.
  bool is_within_line(int32_t v) const {
    if (e_.held[v] != kOnLine || mesh_.stratum(v) != Stratum::curve) return false;
    return std::ranges::all_of(mesh_.along_curve(v),
                               [&](int32_t w) { return e_.held[w] != kFree; });
  }

  // A held line keeps its ends and bends, and what else is held stays.
  bool keeps_line(int32_t from, int32_t to) const {
    if (e_.held[from] == kFree) return true;
    if (!is_within_line(from)) return false;
    const Edge along = mesh_.along_curve(from);
    const int32_t other = along[0] == to ? along[1] : along[0];
    const Vec3 middle = 0.5 * (e_.position[to] + e_.position[other]);
    return options_.onto_line(middle, options_.chord).has_value();
  }

  // Returns whether the angles across an edge sum up to more than half a turn.
  bool is_skew(int32_t a, int32_t b) const {
    const auto& two = mesh_.triangles_at(a, b);
    if (two.size() != 2) return false;
    std::array<double, 2> cosine{}, sine{};
    for (int i = 0; i < 2; ++i) {
      const Vec3& c = e_.position[mesh_.third_corner(two[i], a, b)];
      cosine[i] = dot(e_.position[a] - c, e_.position[b] - c);
      sine[i] = length(cross(e_.position[a] - c, e_.position[b] - c));
    }
    return cosine[0] * sine[1] + cosine[1] * sine[0] < 0;
  }

  void flip_if_flat(int32_t a, int32_t b) {
    const std::array<int32_t, 2> two{mesh_.triangles_at(a, b)[0], mesh_.triangles_at(a, b)[1]};
    const auto normals = normals_of_flip(e_, a, b);
    if (!normals) return;
    mesh_.flip(a, b);
    for (int i = 0; i < 2; ++i) e_.normal[two[i]] = (*normals)[i];
  }

  void find_places() {
    for (auto& places : places_) places.clear();
    for (int32_t v = 0; v < mesh_.vertices(); ++v) {
      const Stratum stratum = mesh_.stratum(v);
      const bool on_curve = stratum == Stratum::curve;
      if (!mesh_.has_triangles(v) || (e_.held[v] != kFree && !is_within_line(v))) continue;
      places_of(stratum).push_back({v, on_curve ? mesh_.along_curve(v) : Edge{}});
    }
  }
  std::vector<Place>& places_of(Stratum stratum) { return places_[static_cast<size_t>(stratum)]; }

  Vec3 wanted_place(const Place& place, Stratum stratum, double share) const {
    const int32_t v = place.vertex;
    if (stratum == Stratum::sheet) return centre_of_sheet(v);
    if (stratum == Stratum::node) return centre_of_curves(v);
    const Vec3 &a = e_.position[place.along[0]], &b = e_.position[place.along[1]];
    const Vec3& here = e_.position[v];
    const Vec3 way = 0.5 * (a + b) - here;
    if (e_.held[v]) return share > 0 ? *options_.onto_line(here + share * way, HUGE_VAL) : here;
    if (options_.moves_curves) return here + share * way;
    const Vec3 tangent = normalized(b - a);
    return here + share * dot(way, tangent) * tangent;
  }

  // Returns the place half way to the mean of the neighbours along the seams of a node; one at a
  // rim is a tip, which would be rounded off.
  Vec3 centre_of_curves(int32_t v) const {
    Vec3 sum;
    const auto beside = mesh_.curve_neighbours(v);
    if (mesh_.stays(v) || beside.empty()) return e_.position[v];
    for (const int32_t other : beside) {
      if (mesh_.uses(v, other) == 1) return e_.position[v];
      sum = sum + e_.position[other];
    }
    return (1 - kStep) * e_.position[v] + (kStep / static_cast<double>(beside.size())) * sum;
  }

  // Returns the mean of the triangles' centres, weighted by area, but no place across the sheet.
  Vec3 centre_of_sheet(int32_t v) const {
    const Vec3& here = e_.position[v];
    Vec3 sum;
    double weight = 0;
    mesh_.for_triangles(v, [&](int32_t t) {
      const Edge others = link_of(mesh_.triangle(t), v);
      const Vec3 a = e_.position[others[0]] - here, b = e_.position[others[1]] - here;
      const double area = length(cross(a, b));
      sum = sum + (area / 3) * (a + b);
      weight += area;
    });
    if (!(weight > 0)) return here;
    const Vec3 way = (1 / weight) * sum, across = normal_at(e_, v);
    return here + way - dot(way, across) * across;
  }

  void step(Stratum stratum, double share) {
    const std::vector<Place>& places = places_of(stratum);
    wanted_.resize(places.size());
    parallel_for(static_cast<int64_t>(places.size()), {run_.threads, nullptr, nullptr},
                 [&](int64_t i) { wanted_[i] = wanted_place(places[i], stratum, share); });
    for (size_t i = 0; i < places.size(); ++i) {
      const int32_t v = places[i].vertex;
      if (wanted_[i] != e_.position[v] && keeps_sides(e_, v, wanted_[i])) move(e_, v, wanted_[i]);
    }
  }

  EvenMesh& e_;
  SheetComplex& mesh_;
  const RemeshOptions& options_;
  const Run& run_;
  std::vector<int32_t> moved_, split_off_;
  std::array<std::vector<Place>, 3> places_;  // what moves, by stratum
  std::vector<Vec3> wanted_;
};

}  // namespace

void merge_close(EvenMesh& even, std::span<const double> within) {
  const SheetComplex& mesh = even.mesh;
  std::vector<int32_t> moved;
  const auto merge = [&](int32_t from, int32_t to) {
    const bool can = mesh.stratum(from) == Stratum::sheet && mesh.can_collapse(from, to) &&
                     turns_none(even, from, to);
    if (can) collapse(even, from, to, moved);
    return can;
  };
  const auto rank_of = [&](int32_t a, int32_t b) {
    const double away = distance(even.position[a], even.position[b]);
    return away < std::min(within[a], within[b]) ? away : HUGE_VAL;
  };
  collapse_all(mesh, rank_of, merge);
}

void remesh(EvenMesh& even, const RemeshOptions& options, const Run& run) {
  Remesher remesher(even, options, run);
  remesher.split();
  remesher.collapse();
  remesher.flip();
  remesher.smooth();
}

}  // namespace medial
