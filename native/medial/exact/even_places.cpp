// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/even_places.h"

#include "base/parallel.h"
#include "base/sort_unique.h"
#include "exact/empty_ball.h"

namespace medial {
namespace {

constexpr int64_t kFew = 64;         // vertices that a thread takes at a time
constexpr double kSamePlace = 1e-3;  // target lengths between places that are one; chosen: unseen
constexpr double kMostSlide = 0.7;   // of the target length that a rim moves at once; chosen: axis
// target lengths: a rim that moves less has ended, and steps along it that differ less agree
constexpr double kSmallStep = 0.05;     // chosen: axis
constexpr double kRimOpenness = 0.004;  // of a rim, whose feet are 7 degrees apart; chosen: axis
constexpr double kPlate = 0.9;  // the openness of a plate with nearly parallel sides; chosen: axis
constexpr double kRimSlope = 0.2;  // of the steps along a rim; chosen: axis
constexpr int kMeans = 6, kMeansOfRoughness = 16;
constexpr int kAlongRounds = 12;     // in which a step learns of those along the rim
constexpr int kHalvingsToLast = 10;  // of the way to the last ball that touches two places

}  // namespace

EvenPlaces::EvenPlaces(EvenMesh& even, const SamplesOnFaces& samples,
                       std::span<const Edge> generators, std::span<const Edge> wires,
                       const Run& run)
    : e_(even),
      samples_(samples),
      generators_(generators),
      run_(run),
      along_wire_(even.position.size(), -1) {
  for (const auto& [a, b] : wires) {
    if (e_.mesh.has_triangles(a)) along_wire_[a] = b;
    if (e_.mesh.has_triangles(b)) along_wire_[b] = a;
  }
}

// Returns the largest hole between the samples of the facets at a vertex.
double EvenPlaces::hole_at(int32_t v) const {
  double most = 0;
  e_.mesh.for_triangles(v, [&](int32_t t) {
    for (const int32_t s : generators_[e_.source[t]]) most = std::max(most, samples_.spacing(s));
  });
  return most;
}

// Returns whether all samples of the facets at a vertex are on faces.
bool EvenPlaces::has_walls(int32_t v) const {
  bool has = true;
  e_.mesh.for_triangles(v, [&](int32_t t) {
    for (const int32_t s : generators_[e_.source[t]]) has = has && samples_.triangle(s) >= 0;
  });
  return has;
}

// Returns the feet of a vertex on the walls of its triangles, nearest first; those that are seen in
// one direction are one.
std::vector<Foot> EvenPlaces::feet_of(int32_t v) const {
  std::vector<int32_t> walls;
  e_.mesh.for_triangles(v, [&](int32_t t) {
    for (const int32_t s : generators_[e_.source[t]]) walls.push_back(samples_.triangle(s));
  });
  sort_unique(walls);
  if (walls.empty() || walls.front() < 0) return {};  // no face is known there
  std::vector<Foot> feet, distinct;
  for (const int32_t t : walls) feet.push_back(samples_.faces().descend(t, e_.position[v]));
  std::stable_sort(feet.begin(), feet.end(),
                   [](const Foot& a, const Foot& b) { return a.distance < b.distance; });
  for (const Foot& foot : feet) {
    const Vec3 away = normalized(e_.position[v] - foot.point);
    const bool is_new = std::none_of(distinct.begin(), distinct.end(), [&](const Foot& other) {
      return distance(normalized(e_.position[v] - other.point), away) <= kSameFoot;
    });
    if (is_new) distinct.push_back(foot);
  }
  return distinct;
}

// A vertex inside a sheet or on its rim has the nearest wall on each side of the sheet. On a seam
// it has a wall for each sheet that meets there, and at a node as many as determine a place.
Walls EvenPlaces::walls_of(int32_t v) const {
  const auto feet = feet_of(v);
  const auto& mesh = e_.mesh;
  size_t most = kMostContacts;
  if (mesh.stratum(v) == Stratum::sheet) most = 2;
  if (mesh.stratum(v) == Stratum::curve) {
    most = std::clamp<size_t>(static_cast<size_t>(mesh.uses(v, mesh.along_curve(v)[0])), 2, 3);
  }
  const Vec3 across = normal_at(e_, v);
  Walls walls;
  double side = 0;
  for (const Foot& foot : feet) {
    const double there = dot(e_.position[v] - foot.point, across);
    if (most == 2 && walls.count == 1 && !(there * side < 0)) continue;
    if (walls.count == 0) side = there;
    if (walls.count < most) walls.add(foot.triangle);
  }
  return walls;
}

Touch EvenPlaces::ball_at(int32_t v) const {
  const Touch ball = ball_of_walls(v);
  const int32_t next = v < static_cast<int32_t>(along_wire_.size()) ? along_wire_[v] : -1;
  if (next < 0 || !(ball.radius > 0)) return ball;
  const Vec3 along = normalized(e_.position[next] - ball.position);
  const Touch end = wire_end(samples_, hole_at(v), ball, along);
  return end.radius > 0 ? end : ball;
}

// Returns the walls of the nearest sample on each side of a sheet; none where sheets meet.
Walls EvenPlaces::nearest_walls(int32_t v) const {
  if (e_.mesh.stratum(v) != Stratum::sheet && !e_.mesh.is_rim(v)) return {};
  const Vec3 across = normal_at(e_, v);
  std::array<int32_t, 2> wall{-1, -1};
  std::array<double, 2> least{HUGE_VAL, HUGE_VAL};
  e_.mesh.for_triangles(v, [&](int32_t t) {
    for (const int32_t s : generators_[e_.source[t]]) {
      const Vec3 off = e_.position[v] - samples_.point(s);
      const int side = dot(off, across) > 0;
      if (!(squared_length(off) < least[side])) continue;
      least[side] = squared_length(off);
      wall[side] = samples_.triangle(s);
    }
  });
  Walls walls;
  for (const int32_t triangle : wall) {
    if (triangle >= 0) walls.add(triangle);
  }
  return walls;
}

// Returns the ball between two smooth walls, without a radius where a rim is beyond the end of its
// sheet; nothing where the walls are not smooth.
std::optional<Touch> EvenPlaces::smooth_ball_at(int32_t v, const Vec3& start,
                                                const Walls& walls) const {
  const double hole = hole_at(v);
  const Touch ball = smooth_ball(samples_, {start, hole}, walls);
  if (!(ball.radius > 0)) return {};
  if (!(openness(ball.away) > kRimOpenness)) return Touch{};  // it has one foot
  if (e_.mesh.stratum(v) == Stratum::sheet) return ball;
  return is_empty_between(samples_, ball, hole) ? ball : Touch{};
}

// Returns the ball of a vertex that sees walls on one side of its sheet only: it is beyond a thin
// wall, whose corner the mesh cuts. There the facets know on which side a wall is, as the normal of
// a triangle points to the second sample of its facet, and the search begins between the feet.
Touch EvenPlaces::ball_from_beyond(int32_t v) const {
  if (e_.mesh.stratum(v) != Stratum::sheet) return {};
  const Vec3 across = normal_at(e_, v);
  std::array<Foot, 2> nearest;
  e_.mesh.for_triangles(v, [&](int32_t t) {
    const bool alike = dot(e_.normal[t], across) > 0;
    for (const int i : {0, 1}) {
      const int32_t wall = samples_.triangle(generators_[e_.source[t]][i]);
      const Foot foot = samples_.faces().descend(wall, e_.position[v]);
      Foot& least = nearest[alike ? i : 1 - i];
      if (foot.distance < least.distance) least = foot;
    }
  });
  Walls walls;
  for (const Foot& foot : nearest) walls.add(foot.triangle);
  const Vec3 between = 0.5 * (nearest[0].point + nearest[1].point);
  return empty_ball(samples_, {e_.position[v], hole_at(v)}, walls, between, 2, true);
}

Touch EvenPlaces::ball_of_walls(int32_t v) const {
  const auto smooth = smooth_ball_at(v, e_.position[v], nearest_walls(v));
  if (smooth && !finishes_) return *smooth;  // rims beyond their end go back to it
  if (smooth && smooth->radius > 0 && is_empty(samples_, *smooth, hole_at(v))) return *smooth;
  const Walls walls = walls_of(v);
  if (walls.count < 2) return walls.count == 1 ? ball_from_beyond(v) : Touch{};
  const size_t most = e_.mesh.stratum(v) == Stratum::node ? kMostContacts : walls.count;
  return empty_ball(samples_, {e_.position[v], hole_at(v)}, walls, e_.position[v], most, true);
}

void EvenPlaces::start_from(std::span<const Placing> placing, std::span<const double> radius) {
  placing_.assign(placing.begin(), placing.end());
  radius_.assign(radius.begin(), radius.end());
}

void EvenPlaces::place() {
  place(vertices_where([](int32_t) { return true; }));
}

void EvenPlaces::finish() {
  finishes_ = true;
  place();
  const auto refused = vertices_where([&](int32_t v) {
    return e_.mesh.stratum(v) == Stratum::sheet && placing_[v] == Placing::refused;
  });
  for (const int32_t v : refused) {
    const Vec3 mean = mean_beside(v);
    if (keeps_sides(e_, v, mean)) move(e_, v, mean);
  }
  place(refused);
}

// Returns the mean of the neighbours of a vertex inside a sheet, each once for its two triangles.
Vec3 EvenPlaces::mean_beside(int32_t v) const {
  Vec3 sum;
  double count = 0;
  e_.mesh.for_corners(v, [&](int32_t other) { sum = sum + e_.position[other], ++count; });
  return (1 / count) * sum;
}

void EvenPlaces::place_rims() {
  std::vector<int32_t> near = open_rims();
  for (size_t i = 0, rims = near.size(); i < rims; ++i) {
    e_.mesh.for_corners(near[i], [&](int32_t other) { near.push_back(other); });
  }
  sort_unique(near);
  place(near);
}

void EvenPlaces::place(std::span<const int32_t> vertices) {
  found_.resize(e_.position.size());
  placing_.resize(e_.position.size(), Placing::voronoi);
  radius_.resize(e_.position.size(), 0);
  parallel_for(
      static_cast<int64_t>(vertices.size()), {run_.threads, nullptr, nullptr},
      [&](int64_t i) {
        const int32_t v = vertices[i];
        found_[v] = e_.held[v] == kFree ? ball_at(v) : Touch{};
      },
      kFew);
  for (const int32_t v : vertices) join_neighbour(v);
  for (const int32_t v : vertices) {
    if (!e_.mesh.has_triangles(v) || e_.held[v] == kStill) continue;
    if (e_.held[v] != kFree) {
      placing_[v] = e_.held[v] == kInCorner ? Placing::corner : Placing::crease;
      continue;
    }
    placing_[v] = Placing::voronoi;
    if (!has_walls(v)) continue;
    const Touch& ball = found_[v];
    const bool fits = ball.radius > 0 && distance(ball.position, e_.position[v]) < e_.target[v] &&
                      can_be_placed(e_, v, ball.position);
    placing_[v] = fits ? Placing::touching : Placing::refused;
    if (!fits) continue;
    move(e_, v, ball.position);
    radius_[v] = ball.radius;
  }
}

// Neighbours with the same ball become one: triangles between them would have no area.
void EvenPlaces::join_neighbour(int32_t v) {
  if (!(found_[v].radius > 0) || !e_.mesh.has_triangles(v)) return;
  int32_t same = -1;
  e_.mesh.for_corners(v, [&](int32_t other) {
    if (same >= 0 || !(found_[other].radius > 0)) return;
    const double apart = distance(found_[v].position, found_[other].position);
    if (apart < kSamePlace * e_.target[v] && e_.mesh.can_collapse(v, other)) same = other;
  });
  if (same >= 0) e_.mesh.collapse(v, same);
}

std::vector<int32_t> EvenPlaces::open_rims() const {
  return vertices_where([&](int32_t v) { return e_.held[v] == kFree && e_.mesh.is_rim(v); });
}

std::vector<EvenPlaces::OnRim> EvenPlaces::along_rims(std::span<const int32_t> rims) const {
  std::vector<OnRim> found;
  found.reserve(rims.size());
  for (const int32_t v : rims) found.push_back({v, e_.mesh.along_curve(v)});
  return found;
}

SmoothRim EvenPlaces::way_out(int32_t v) const {
  if (placing_[v] == Placing::refused) return last_ball(v);
  if (placing_[v] != Placing::touching || found_[v].walls.count != 2) return {};
  const SmoothRim smooth = smooth_rim_of(samples_.faces(), hole_at(v), found_[v]);
  return smooth.reach > 0 ? smooth : before_third_wall(v);
}

// Where a plate ends, a third wall or a fillet stops the balls between its two sides. A plate that
// is thinner than the holes between its samples shows no sheets that go on into its edges.
SmoothRim EvenPlaces::before_third_wall(int32_t v) const {
  if (!has_parallel_walls(v)) return {};
  const Vec3 far = e_.position[v] + hole_at(v) * outward_at(v);
  if (ball_between(v, far).radius > 0) return {};
  return {distance(last_place(v, far), e_.position[v]), true};
}

bool EvenPlaces::has_parallel_walls(int32_t v) const { return openness(found_[v].away) > kPlate; }

Touch EvenPlaces::ball_between(int32_t v, const Vec3& start) const {
  if (const auto smooth = smooth_ball_at(v, start, found_[v].walls)) return *smooth;
  return empty_ball(samples_, {start, hole_at(v)}, found_[v].walls, start, 2);
}

// Returns the last ball's place on the way from a vertex to a place without one.
Vec3 EvenPlaces::last_place(int32_t v, const Vec3& far) const {
  double low = 0, high = 1;
  Vec3 last = e_.position[v];
  for (int i = 0; i < kHalvingsToLast; ++i) {
    const double share = 0.5 * (low + high);
    const Touch ball = ball_between(v, (1 - share) * e_.position[v] + share * far);
    (ball.radius > 0 ? low : high) = share;
    if (ball.radius > 0) last = ball.position;
  }
  return last;
}

// A rim that lies beyond the last ball that touches two places goes back to it. The ball is between
// the vertex and a neighbour in the sheet, as at a fillet, all of whose balls have one centre.
SmoothRim EvenPlaces::last_ball(int32_t v) const {
  int32_t inner = -1;
  e_.mesh.for_corners(v, [&](int32_t other) {
    if (e_.mesh.stratum(other) != Stratum::sheet) return;
    if (placing_[other] != Placing::touching || found_[other].walls.count != 2) return;
    const auto away = [&](int32_t at) { return distance(e_.position[at], e_.position[v]); };
    if (inner < 0 || away(other) < away(inner)) inner = other;
  });
  if (inner < 0) return {};
  const Vec3 last = last_place(inner, e_.position[v]);
  if (last == e_.position[inner]) return {};
  return {distance(last, e_.position[v]),
          has_parallel_walls(inner) || is_beyond_walls(inner, e_.position[v])};
}

// Returns whether a place is on the outer side of a wall of a vertex.
bool EvenPlaces::is_beyond_walls(int32_t v, const Vec3& place) const {
  Walls walls = found_[v].walls;
  return std::ranges::any_of(walls.all(), [&](int32_t triangle) {
    const Foot foot = samples_.faces().descend(triangle, place);
    return dot(place - foot.point, samples_.faces().normal(foot.triangle, foot.at)) > 0;
  });
}

// The squared sine of half the angle between the feet falls nearly linearly towards the end, where
// it is 0. Rims go to where it is least, as far as two feet can be told apart.
double EvenPlaces::step_of(int32_t v, const SmoothRim& way) const {
  if (placing_[v] == Placing::refused) return -way.reach;
  if (way.at_wall) return way.reach;
  return way.reach * (1 - kRimOpenness / openness(found_[v].away));
}

// Returns means along rims, of a vertex and those beside it; what is not known is NaN, and takes on
// the mean of what is known beside it.
void EvenPlaces::take_means(std::span<const OnRim> rims, int rounds, std::vector<double>& values) {
  std::vector<double> means(values);
  for (int round = 0; round < rounds; ++round) {
    for (const auto& [v, along] : rims) {
      double sum = 0, weight = 0;
      const auto add = [&](double value, double share) {
        if (std::isnan(value)) return;
        sum += share * value;
        weight += share;
      };
      add(values[v], 0.5);
      for (const int32_t other : along) add(values[other], 0.25);
      means[v] = weight > 0 ? sum / weight : values[v];
    }
    std::swap(values, means);
  }
}

// Steps that the places of single vertices ask for are noise where the faces are rough. There rims
// stay where they are smooth; elsewhere they take the means along the rim.
void EvenPlaces::even_out(std::span<const OnRim> rims, std::span<const SmoothRim> way,
                          std::vector<double>& step) const {
  std::vector<double> raw(step), rough(step.size(), NAN);
  take_means(rims, kMeans, step);
  for (const auto& [v, along] : rims) rough[v] = std::abs(raw[v] - step[v]) / e_.target[v];
  take_means(rims, kMeansOfRoughness, rough);
  for (const auto& [v, along] : rims) {
    if (!(rough[v] < kSmallStep) && !way[v].at_wall) {
      step[v] = 0;
    } else if (way[v].at_wall) {
      step[v] = raw[v];
    } else if (raw[v] < 0) {
      step[v] = std::min(step[v], raw[v]);  // there is nothing beyond the end
    }
  }
  for (int round = 0; round < kAlongRounds; ++round) {
    for (const auto& [v, along] : rims) {
      for (const int32_t other : along) {
        const double apart = distance(e_.position[v], e_.position[other]);
        if (!std::isnan(step[other])) step[v] = std::min(step[v], step[other] + kRimSlope * apart);
      }
    }
  }
}

bool EvenPlaces::slide() {
  const std::vector<int32_t> rims = open_rims();
  std::vector<SmoothRim> way(e_.position.size());
  std::vector<double> step(e_.position.size(), NAN);
  parallel_for(
      static_cast<int64_t>(rims.size()), {run_.threads, nullptr, nullptr},
      [&](int64_t i) {
        const int32_t v = rims[i];
        way[v] = way_out(v);
        if (way[v].reach > 0) step[v] = step_of(v, way[v]);
      },
      kFew);
  even_out(along_rims(rims), way, step);
  went_back_.resize(e_.position.size(), 0);
  double most = 0;
  for (const int32_t v : rims) {
    if (std::isnan(step[v])) continue;  // no step is known near it
    const double limit = kMostSlide * e_.target[v];
    const double back = std::clamp(hole_at(v) - went_back_[v], 0.0, limit);
    const double now = std::clamp(step[v], -back, limit);
    went_back_[v] -= std::min(now, 0.0);
    most = std::max(most, std::abs(now) / e_.target[v]);
    const Vec3 place = e_.position[v] + now * outward_at(v);
    if (now != 0 && keeps_sides(e_, v, place)) move(e_, v, place);
  }
  return most > kSmallStep;
}

// Returns the direction in which a sheet ends at a vertex of its rim: away from the third corners
// of its triangles, across the rim.
Vec3 EvenPlaces::outward_at(int32_t v) const {
  const auto [a, b] = e_.mesh.along_curve(v);
  const Vec3 along = normalized(e_.position[b] - e_.position[a]);
  Vec3 inner;
  e_.mesh.for_corners(v,
                      [&](int32_t other) { inner = inner + e_.position[other] - e_.position[v]; });
  const Vec3 across = normal_at(e_, v);
  inner = inner - dot(inner, along) * along - dot(inner, across) * across;
  return -normalized(inner);
}

}  // namespace medial
