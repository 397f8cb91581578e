// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp.h"

#include "base/atomic.h"
#include "base/flat_polygon.h"
#include "base/point_tree.h"
#include "base/union_find.h"
#include "contact/touching_ball.h"

namespace medial {
namespace {

// All lengths are in holes between the samples, as in samples_on_faces.cpp.
constexpr double kExact = 1e-10;       // the largest difference between a radius and the distance
constexpr double kFarthestMove = 2;    // that a vertex moves to touch walls
constexpr double kNearCrease = 8;      // the largest ball of a rim that ends in a crease
constexpr double kNearAccident = 3.5;  // the same of one that may be no crease
constexpr double kNearCorner = 2.5;    // from the end of a rim to a corner of the solid
constexpr double kSameFoot = 0.08;     // between unit directions to feet that are one
constexpr int kMoreWalls = 4;          // attempts to add a wall that the ball sticks out of
constexpr int kRounds = 24;            // of steps that unfold facets
constexpr int kOwnRounds = 3;          // of these, the rounds without the neighbours
constexpr int kDentRounds = 6;         // of these, the rounds that mend deep dents, too
constexpr double kDeepDent = 0.25;     // the sine of the turn
// A smooth rim is looked for where a ball touches two places that are seen under less than 84
// degrees.
constexpr double kMostOpen = 0.45;          // the squared sine of half the angle
constexpr double kFarOut = 0.8;             // of the way to the rim that balls are tried on
constexpr double kFarthestRim = 0.5;        // from the last vertex to the rim, in radii
constexpr double kLongerThanBeside = 1.25;  // of the way of a vertex to that of its neighbours
constexpr int kRimRounds = 3;
constexpr double kCertainRim = 0.85;  // of the vertices of a rim must have found it
constexpr double kBent = 0.4;  // the largest deviation from a line, as a share of the openness
constexpr int kRimSteps = 4;
constexpr int kBisections = 40;       // of the way to the last ball that touches two places
constexpr double kSameCrease = 0.85;  // the cosine between creases of one direction

// Holds the walls that a ball touches, by triangles of the mesh.
struct Walls {
  std::array<int32_t, kMostContacts> triangle{-1, -1, -1, -1};
  size_t count = 0;

  std::span<int32_t> all() { return {triangle.data(), count}; }
  bool add(int32_t t) {
    if (count == kMostContacts) return false;
    triangle[count++] = t;
    return true;
  }
};

class CrispMaker {
 public:
  CrispMaker(const InnerComplex& complex, const Triangulation& t, const SamplesOnFaces& samples,
             std::span<const Thickness> facets, std::span<const double> sine,
             std::span<const uint8_t> selected, const Run& run)
      : complex_(complex),
        t_(t),
        samples_(samples),
        sine_(sine),
        run_{run.threads, nullptr, run.arena},
        progress_(run.progress) {
    find_facets(facets);
    find_rims();
    find_hidden(selected);
    find_corners();
  }

  CrispPlaces make() {
    made_.position = {complex_.position.begin(), complex_.position.end()};
    made_.radius = {complex_.radius.begin(), complex_.radius.end()};
    made_.place = Array<Placing>(complex_.cell.size(), Placing::voronoi);
    made_.reach = samples_.reach();
    walls_ = array<Walls>(complex_.cell.size(), Walls{}, run_);
    rim_ = array<SmoothRim>(complex_.cell.size(), SmoothRim{}, run_);
    parallel_for(
        complex_.vertices(), {run_.threads, progress_, run_.arena},
        [&](int64_t v) {
          if (!facets_at_[v].empty()) place(static_cast<int32_t>(v));
        },
        256);
    settle_rims();
    end_fillets();
    reach_corners();
    join_seams();
    unfold();
    return std::move(made_);
  }

 private:
  // Facets of K1 that noise of the samples may have caused keep their places.
  static bool is_certain(const Thickness& value) {
    return value.sheet > 0 && value.spacings > 1 && value.erosion > 0;
  }

  // Lists the facets of K1 at each vertex, and counts those at each edge.
  void find_facets(std::span<const Thickness> facets) {
    for (int32_t f = 0; f < complex_.facets(); ++f) {
      if (is_certain(facets[f])) facets_.push_back(f);
    }
    facets_at_.offsets = array<int64_t>(complex_.cell.size() + 1, 0, run_);
    edge_uses_ = array<uint8_t>(complex_.ends.size(), 0, run_);
    for_corners([&](int32_t, const Corner& c) {
      ++facets_at_.offsets[c.vertex];
      if (edge_uses_[c.edge] < 3) ++edge_uses_[c.edge];
    });
    counts_to_offsets(facets_at_.offsets);
    facets_at_.items = array<int32_t>(static_cast<size_t>(facets_at_.offsets.back()), run_);
    std::vector<int64_t> next(facets_at_.offsets.begin(), facets_at_.offsets.end());
    for_corners([&](int32_t f, const Corner& c) { facets_at_.items[next[c.vertex]++] = f; });
  }
  template <typename Found>
  void for_corners(const Found& found) const {
    for (const int32_t f : facets_) {
      for (const Corner& c : complex_.ring(f)) found(f, c);
    }
  }

  void find_rims() {
    on_rim_ = array<uint8_t>(complex_.cell.size(), 0, run_);
    for (size_t e = 0; e < complex_.ends.size(); ++e) {
      if (edge_uses_[e] != 1) continue;
      for (const int32_t v : complex_.ends[e]) on_rim_[v] = 1;
    }
  }

  // Lists the pairs of samples that selected facets without area separate at a vertex.
  void find_hidden(std::span<const uint8_t> selected) {
    for (size_t i = 0; i < complex_.shrunk.size(); ++i) {
      if (!selected[i]) continue;
      const ShrunkFacet& s = complex_.shrunk[i];
      hidden_.push_back({s.vertex, s.generators[0], s.generators[1]});
      if (s.edge < 0) continue;
      for (const int32_t v : complex_.ends[s.edge]) {
        hidden_.push_back({v, s.generators[0], s.generators[1]});
      }
    }
    std::sort(hidden_.begin(), hidden_.end());
  }

  void find_corners() {
    std::vector<Vec3> corners;
    const auto& mesh = samples_.faces().mesh();
    for (size_t p = 0; p < mesh.points.size(); ++p) {
      if (samples_.creases().is_corner(static_cast<int32_t>(p))) corners.push_back(mesh.points[p]);
    }
    if (!corners.empty()) corners_ = PointTree::sorted(corners, run_);
    corner_points_ = std::move(corners);
  }

  void place(int32_t v) {
    if (on_rim_[v] && onto_crease(v)) return;
    Touch found;
    for (const bool thorough : {false, true}) {
      const Walls walls = walls_at(v, thorough);
      if (walls.count < 2) return;
      found = touch(v, walls, complex_.position[v]);
      if (found.radius > 0) break;
    }
    made_.place[v] = found.radius > 0 ? Placing::touching : Placing::refused;
    if (!(found.radius > 0)) return;
    take(v, found);
    if (on_rim_[v] && found.walls.count == 2) find_rim(v, found);
  }

  double spacing_at(int32_t v) const {
    double most = 0;
    for (const int32_t f : facets_at_[v]) {
      for (const int32_t s : complex_.generators[f]) most = std::max(most, samples_.spacing(s));
    }
    return most;
  }

  // --- rims that end in creases

  bool onto_crease(int32_t v) {
    const double spacing = spacing_at(v);
    if (!(complex_.radius[v] < kNearCrease * spacing)) return false;
    std::optional<PlaceOnCrease> nearest;
    bool at_corner = false;
    for (const int32_t f : facets_at_[v]) {
      const auto found = samples_.crease_between(complex_.generators[f], complex_.position[v]);
      if (!found || distance(found->point, complex_.position[v]) > reach_of(*found) * spacing) {
        continue;
      }
      if (nearest && !same_direction(*nearest, *found)) at_corner = true;
      if (!nearest || distance(found->point, complex_.position[v]) <
                          distance(nearest->point, complex_.position[v])) {
        nearest = found;
      }
    }
    if (!nearest) return false;
    made_.position[v] = nearest->point;
    made_.radius[v] = 0;
    const bool jagged = samples_.creases().is_jagged(nearest->edge);
    made_.place[v] = jagged ? Placing::rim : Placing::crease;
    if (at_corner && !jagged) onto_corner(v, kNearCrease * spacing);
    return true;
  }

  // Sharp edges that divide nothing are often accidents of a coarse mesh.
  double reach_of(const PlaceOnCrease& place) const {
    return samples_.creases().divides(place.edge) ? kNearCrease : kNearAccident;
  }

  void onto_corner(int32_t v, double within) {
    if (corner_points_.empty()) return;
    const Neighbour nearest = corners_.nearest(complex_.position[v]);
    if (nearest.distance > within) return;
    made_.position[v] = corner_points_[nearest.id];
    made_.place[v] = Placing::corner;
  }

  bool same_direction(const PlaceOnCrease& a, const PlaceOnCrease& b) const {
    if (a.edge == b.edge) return true;
    return std::abs(dot(direction(a.edge), direction(b.edge))) > kSameCrease;
  }
  Vec3 direction(int32_t edge) const {
    const auto& mesh = samples_.faces().mesh();
    const auto& [a, b] = samples_.faces().creases().edges[edge].ends;
    return normalized(mesh.points[b] - mesh.points[a]);
  }

  // Moves the nearest vertex on a crease to each corner that no vertex has reached.
  void reach_corners() {
    if (corner_points_.empty()) return;
    std::vector<uint8_t> reached(corner_points_.size(), 0);
    std::vector<int32_t> on_crease;
    std::vector<Vec3> places;
    for (int32_t v = 0; v < complex_.vertices(); ++v) {
      if (made_.place[v] == Placing::corner) {
        reached[corners_.nearest(made_.position[v]).id] = 1;
      } else if (made_.place[v] == Placing::crease) {
        on_crease.push_back(v);
        places.push_back(made_.position[v]);
      }
    }
    if (places.empty()) return;
    const PointTree tree = PointTree::sorted(places, run_);
    for (size_t c = 0; c < reached.size(); ++c) {
      if (reached[c]) continue;
      const Neighbour nearest = tree.nearest(corner_points_[c]);
      const int32_t v = on_crease[nearest.id];
      if (nearest.distance > kNearCorner * spacing_at(v)) continue;
      made_.position[v] = corner_points_[c];
      made_.place[v] = Placing::corner;
    }
  }

  // --- balls that touch walls

  // Returns the walls of a vertex: its samples are of one wall where no facet separates them. On a
  // curved wall all samples mostly have one foot, so the first one will do unless `thorough`.
  Walls walls_at(int32_t v, bool thorough) const {
    const Groups groups = groups_at(v);
    Walls walls;
    for (size_t g = 0; g < groups.samples.size(); ++g) {
      if (groups.group[g] != g) continue;
      const int32_t t = nearest_wall(v, groups, g, thorough);
      if (t < 0) return {};
      if (!walls.add(t)) break;
    }
    return walls.count < 2 ? walls_of_facet(v) : walls;
  }

  // Holds the samples of a vertex, each with the first one of its group.
  struct Groups {
    std::vector<int32_t> samples;
    std::vector<size_t> group;

    size_t find(int32_t sample) {
      for (size_t i = 0; i < samples.size(); ++i) {
        if (samples[i] == sample) return i;
      }
      samples.push_back(sample);
      group.push_back(group.size());
      return group.size() - 1;
    }
    void unite(size_t a, size_t b) {
      const size_t low = std::min(group[a], group[b]), high = std::max(group[a], group[b]);
      for (size_t& g : group) {
        if (g == high) g = low;
      }
    }
  };

  Groups groups_at(int32_t v) const {
    Groups groups;
    for_cells(v, [&](const Cell& cell) {
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
          if (is_separated(v, cell[i], cell[j])) continue;
          const size_t a = groups.find(cell[i]), b = groups.find(cell[j]);
          groups.unite(a, b);
        }
        groups.find(cell[i]);
      }
    });
    return groups;
  }

  // Calls found(cell) for the cells that were merged into a vertex.
  template <typename Found>
  void for_cells(int32_t v, const Found& found) const {
    found(t_.cells[complex_.cell[v]]);
    const auto& merged = complex_.merged;
    auto next = std::lower_bound(merged.begin(), merged.end(), Edge{v, -1});
    for (; next != merged.end() && (*next)[0] == v; ++next) found(t_.cells[(*next)[1]]);
  }

  bool is_separated(int32_t v, int32_t p, int32_t q) const {
    const auto is_pair = [&](const Edge& g) {
      return (g[0] == p && g[1] == q) || (g[0] == q && g[1] == p);
    };
    for (const int32_t f : facets_at_[v]) {
      if (is_pair(complex_.generators[f])) return true;
    }
    auto next = std::lower_bound(hidden_.begin(), hidden_.end(), Hidden{v, -1, -1});
    for (; next != hidden_.end() && (*next)[0] == v; ++next) {
      if (is_pair({(*next)[1], (*next)[2]})) return true;
    }
    return false;
  }

  // Returns the triangle of the nearest foot of the samples of a group, or -1 if one has no face.
  int32_t nearest_wall(int32_t v, const Groups& groups, size_t group, bool thorough) const {
    Foot best;
    for (size_t i = 0; i < groups.samples.size(); ++i) {
      if (groups.group[i] != group) continue;
      const int32_t t = samples_.triangle(groups.samples[i]);
      if (t < 0) return -1;
      if (!thorough && samples_.faces().is_curved(t)) return t;
      const Foot foot = samples_.faces().descend(t, complex_.position[v]);
      if (foot.distance < best.distance) best = foot;
    }
    return best.triangle;
  }

  // Returns the walls of the facet that separates its samples most.
  Walls walls_of_facet(int32_t v) const {
    int32_t best = -1;
    for (const int32_t f : facets_at_[v]) {
      if (best < 0 || sine_[f] > sine_[best]) best = f;
    }
    Walls walls;
    for (const int32_t s : complex_.generators[best]) {
      if (samples_.triangle(s) < 0) return {};
      walls.add(samples_.triangle(s));
    }
    return walls;
  }

  struct Touch {
    Vec3 position;
    double radius = 0;  // 0: there is no empty ball that touches the walls
    Walls walls{};
    std::array<Vec3, kMostContacts> away{};  // unit directions from the feet
  };

  void take(int32_t v, const Touch& found) {
    made_.position[v] = found.position;
    made_.radius[v] = found.radius;
    walls_[v] = found.walls;
  }

  // Moves a vertex of a smooth rim outward to where the two feet become one: there the openness is
  // 0. It falls linearly towards the rim; the line is fitted to several balls on the way, because
  // the curvature of curved triangles jumps from one to the next.
  void find_rim(int32_t v, const Touch& inner) {
    const double first = openness(inner.away);
    if (!(first < kMostOpen)) return;
    const double farthest = kFarthestRim * inner.radius;
    const Vec3 outward = -normalized(inner.away[0] + inner.away[1]);
    double reach = distance_to_rim(inner, 0.25 * spacing_at(v) * outward, 1);
    for (int i = 0; i < 2; ++i) {
      if (!(reach < farthest)) return;
      reach = distance_to_rim(inner, (kFarOut * reach / kRimSteps) * outward, kRimSteps);
    }
    if (reach < farthest) rim_[v] = {outward, reach};
  }

  // Moves the vertices of smooth rims. A vertex goes no farther than the rim beside it does.
  void settle_rims() {
    for (int round = 0; round < kRimRounds; ++round) {
      auto settled = array<double>(rim_.size(), run_);
      parallel_for(complex_.vertices(), run_,
                   [&](int64_t v) { settled[v] = settled_reach(static_cast<int32_t>(v)); });
      for (size_t v = 0; v < rim_.size(); ++v) rim_[v].reach = settled[v];
    }
    leave_doubtful_rims();
    parallel_for(complex_.vertices(), run_, [&](int64_t v) {
      if (rim_[v].reach > 0) {
        end_on_rim(static_cast<int32_t>(v), made_.position[v] + rim_[v].reach * rim_[v].outward);
      }
    });
  }

  // A rim moves as a whole or not at all: where too few of its vertices have found the end of the
  // sheet, as on noisy bodies, it would become ragged.
  void leave_doubtful_rims() {
    UnionFind rims(rim_.size());
    for (size_t e = 0; e < complex_.ends.size(); ++e) {
      if (edge_uses_[e] == 1) rims.unite(complex_.ends[e][0], complex_.ends[e][1]);
    }
    const auto rim = std::move(rims).representatives();
    std::vector<int32_t> all(rim_.size(), 0), found(rim_.size(), 0);
    for (int32_t v = 0; v < complex_.vertices(); ++v) {
      if (!on_rim_[v] || made_.place[v] >= Placing::rim) continue;
      ++all[rim[v]];
      found[rim[v]] += rim_[v].reach > 0;
    }
    for (int32_t v = 0; v < complex_.vertices(); ++v) {
      if (found[rim[v]] < kCertainRim * all[rim[v]]) rim_[v].reach = 0;
    }
  }

  double settled_reach(int32_t v) const {
    if (!(rim_[v].reach > 0)) return 0;
    std::vector<double> beside{rim_[v].reach};
    for_edges(v, [&](const Corner& c, int32_t other) {
      if (edge_uses_[c.edge] == 1) beside.push_back(rim_[other].reach);
    });
    const auto middle = beside.begin() + static_cast<std::ptrdiff_t>((beside.size() - 1) / 2);
    std::nth_element(beside.begin(), middle, beside.end());
    return std::min(rim_[v].reach, kLongerThanBeside * *middle);
  }

  // Returns how far the openness of the balls after some steps lets the rim be; infinite if it does
  // not fall, or not linearly. At the rim of a fillet it drops at once where the balls of the
  // fillet have their common centre.
  double distance_to_rim(const Touch& inner, const Vec3& step, int steps) const {
    Walls walls = inner.walls;
    Vec3 position = inner.position;
    const double first = openness(inner.away);
    double products = 0, squares = 0;
    std::vector<std::array<double, 2>> lost;  // how far, and how much of the openness
    for (int i = 0; i < steps; ++i) {
      const TouchingBall ball = touching_ball(samples_.faces(), walls.all(), position + step);
      position = ball.centre;
      const double along = distance(position, inner.position);
      lost.push_back({along, first - openness(ball.away)});
      products += along * lost.back()[1];
      squares += along * along;
    }
    if (!(products > 0)) return HUGE_VAL;
    const double slope = products / squares;
    const bool straight = std::all_of(lost.begin(), lost.end(), [&](const auto& at) {
      return std::abs(at[1] - slope * at[0]) < kBent * first;
    });
    return straight ? first / slope : HUGE_VAL;
  }

  // --- rims of fillets

  // Vertices beyond the last ball that touches two places go back to that ball. It lies between
  // them and a neighbour that has found its place, as at a fillet, all of whose balls have one
  // centre.
  void end_fillets() {
    const auto beyond =
        parallel_append<int32_t>(complex_.vertices(), run_, [&](int64_t v, auto& out, int) {
          if (on_rim_[v] && made_.place[v] == Placing::refused) {
            out.push_back(static_cast<int32_t>(v));
          }
        });
    std::vector<Touch> found(beyond.size());
    parallel_for(
        static_cast<int64_t>(beyond.size()), run_,
        [&](int64_t i) { found[i] = last_ball(beyond[i]); }, 64);
    for (size_t i = 0; i < beyond.size(); ++i) {
      if (!(found[i].radius > 0)) continue;
      take(beyond[i], found[i]);
      made_.place[beyond[i]] = Placing::touching;
    }
  }

  Touch last_ball(int32_t v) const {
    const int32_t inner = placed_neighbour(v);
    if (inner < 0 || walls_[inner].count != 2) return {};
    Touch last;
    double low = 0, high = 1;
    for (int i = 0; i < kBisections; ++i) {
      const double share = 0.5 * (low + high);
      const Vec3 start = (1 - share) * made_.position[inner] + share * complex_.position[v];
      const Touch ball = touch(v, walls_[inner], start);
      const bool ends = !(ball.radius > 0) || ball.walls.count != 2;
      (ends ? high : low) = share;
      if (!ends) last = ball;
    }
    return last;
  }

  // Returns the nearest neighbour of a vertex that touches walls, or -1.
  int32_t placed_neighbour(int32_t v) const {
    int32_t best = -1;
    const auto away = [&](int32_t other) {
      return distance(complex_.position[other], complex_.position[v]);
    };
    for (const int32_t f : facets_at_[v]) {
      for (const Corner& c : complex_.ring(f)) {
        if (made_.place[c.vertex] != Placing::touching) continue;
        if (best < 0 || away(c.vertex) < away(best)) best = c.vertex;
      }
    }
    return best;
  }

  // Returns the squared sine of half the angle between the directions to the first two feet.
  static double openness(const std::array<Vec3, kMostContacts>& away) {
    return 0.5 * (1 - dot(away[0], away[1]));
  }

  void end_on_rim(int32_t v, const Vec3& position) {
    const auto foot = samples_.faces().nearer(position, HUGE_VAL);
    if (!samples_.are_near(foot->point)) return;
    made_.position[v] = position;
    made_.radius[v] = foot->distance;
    made_.place[v] = Placing::rim;
  }

  // Finds the ball that touches some walls near a place. A wall that it sticks out of is added.
  Touch touch(int32_t v, Walls walls, Vec3 start) const {
    const double spacing = spacing_at(v), tolerance = kExact * spacing;
    for (int i = 0; i < kMoreWalls; ++i) {
      const TouchingBall ball = touching_ball(samples_.faces(), walls.all(), start);
      if (!(ball.unequal <= tolerance)) return {};
      if (!(distance(ball.centre, complex_.position[v]) <= kFarthestMove * spacing)) return {};
      if (!touches_twice(ball, walls.count)) return {};
      const auto nearer = samples_.faces().nearer(ball.centre, ball.radius - tolerance);
      if (!nearer) {
        if (!touches_samples(ball, walls.count)) return {};
        return {ball.centre, ball.radius, walls, ball.away};
      }
      if (!samples_.are_near(nearer->point) || !walls.add(nearer->triangle)) break;
      start = ball.centre;
    }
    return {};
  }

  // Returns whether there are samples near all feet: a ball may have rolled to a face inside the
  // solid, which bounds nothing.
  bool touches_samples(const TouchingBall& ball, size_t walls) const {
    for (size_t i = 0; i < walls; ++i) {
      if (!samples_.are_near(ball.centre - ball.radius * ball.away[i])) return false;
    }
    return true;
  }

  // Returns whether the feet are not all in one place, as they are beyond the rim of a sheet.
  static bool touches_twice(const TouchingBall& ball, size_t walls) {
    for (size_t i = 1; i < walls; ++i) {
      if (distance(ball.away[i], ball.away[0]) > kSameFoot) return true;
    }
    return false;
  }

  // --- seams

  // A vertex may reach a seam without being on one: the sheet of the samples goes on a little where
  // that of the faces ends. It follows the nearest neighbour that is on the seam, or else the order
  // along the seam would be lost.
  void join_seams() {
    follows_ = array<int32_t>(complex_.cell.size(), -1, run_);
    parallel_for(complex_.vertices(), run_, [&](int64_t id) {
      const auto v = static_cast<int32_t>(id);
      if (reaches_seam(v) && !is_on_seam(v)) follows_[v] = neighbour_on_seam(v);
    });
    for (int32_t v = 0; v < complex_.vertices(); ++v) {
      if (follows_[v] >= 0) followers_.push_back(v);
    }
    follow();
  }

  void follow() {
    for (const int32_t v : followers_) {
      made_.position[v] = made_.position[follows_[v]];
      made_.radius[v] = made_.radius[follows_[v]];
    }
  }

  bool reaches_seam(int32_t v) const {
    return made_.place[v] == Placing::touching && walls_[v].count >= 3;
  }

  bool is_on_seam(int32_t v) const {
    bool found = false;
    for_edges(v, [&](const Corner& c, int32_t) { found |= edge_uses_[c.edge] == 3; });
    return found;
  }

  int32_t neighbour_on_seam(int32_t v) const {
    int32_t best = -1;
    const auto away = [&](int32_t other) {
      return distance(complex_.position[other], complex_.position[v]);
    };
    for_edges(v, [&](const Corner&, int32_t other) {
      if (!reaches_seam(other) || !is_on_seam(other)) return;
      if (best < 0 || away(other) < away(best) || (away(other) == away(best) && other < best)) {
        best = other;
      }
    });
    return best;
  }

  // Calls found(corner, other) for the edges of each facet at a vertex, where `corner` names the
  // edge and `other` is its other end.
  template <typename Found>
  void for_edges(int32_t v, const Found& found) const {
    for (const int32_t f : facets_at_[v]) {
      const auto ring = complex_.ring(f);
      for (size_t i = 0; i < ring.size(); ++i) {
        const size_t next = (i + 1) % ring.size();
        if (ring[i].vertex == v) found(ring[i], ring[next].vertex);
        if (ring[next].vertex == v) found(ring[i], ring[i].vertex);
      }
    }
  }

  // --- folds

  // Facets fold where places that nearly coincide changed their order. Their vertices take steps
  // towards the middle of their neighbours, along the seam or crease that they are on.
  void unfold() {
    std::vector<int32_t> suspects = facets_;
    for (int round = 0; round < kRounds; ++round) {
      throw_if_cancelled(progress_);
      std::vector<int32_t> vertices = folded_vertices(suspects, round < kDentRounds);
      if (vertices.empty()) return;
      if (round >= kOwnRounds) vertices = with_neighbours(vertices);
      suspects = facets_round(vertices);
      std::vector<Touch> found(vertices.size());
      parallel_for(
          static_cast<int64_t>(vertices.size()), run_,
          [&](int64_t i) { found[i] = step_of(vertices[i]); }, 64);
      for (size_t i = 0; i < vertices.size(); ++i) {
        const int32_t v = vertices[i];
        if (made_.place[v] == Placing::crease) {
          made_.position[v] = found[i].position;
        } else if (found[i].radius > 0) {
          take(v, found[i]);
        }
      }
      follow();
    }
  }

  // Returns the vertices of folded facets out of some, and of dented ones if wanted, ascending.
  std::vector<int32_t> folded_vertices(std::span<const int32_t> suspects, bool dented) const {
    auto vertices = parallel_append<int32_t>(static_cast<int64_t>(suspects.size()), run_,
                                             [&](int64_t i, auto& out, int) {
                                               if (!is_folded(suspects[i], dented)) return;
                                               for (const Corner& c : complex_.ring(suspects[i]))
                                                 out.push_back(c.vertex);
                                             });
    sort_out(vertices);
    return vertices;
  }

  std::vector<int32_t> with_neighbours(std::span<const int32_t> vertices) const {
    std::vector<int32_t> all;
    for (const int32_t v : vertices) {
      for (const int32_t f : facets_at_[v]) {
        for (const Corner& c : complex_.ring(f)) all.push_back(c.vertex);
      }
    }
    sort_out(all);
    return all;
  }

  // Returns the facets at some vertices, and at those that follow them.
  std::vector<int32_t> facets_round(std::span<const int32_t> vertices) const {
    std::vector<int32_t> all;
    for (const int32_t v : vertices)
      all.insert(all.end(), facets_at_[v].begin(), facets_at_[v].end());
    for (const int32_t v : followers_) {
      if (!std::binary_search(vertices.begin(), vertices.end(), follows_[v])) continue;
      all.insert(all.end(), facets_at_[v].begin(), facets_at_[v].end());
    }
    sort_out(all);
    return all;
  }

  static void sort_out(std::vector<int32_t>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }

  // Returns whether a facet is turned over, or its boundary runs back or crosses itself, as seen
  // along the line between its samples; if `dented`, also whether it has a deep dent. A facet at
  // the rim of a hole has a slight one.
  bool is_folded(int32_t facet, bool dented) const {
    const auto ring = complex_.ring(facet);
    const auto& [p, q] = complex_.generators[facet];
    const auto [right, up] = across(normalized(samples_.point(q) - samples_.point(p)));
    std::vector<FlatPoint> corners;
    const Vec3& origin = made_.position[ring[0].vertex];
    for (const Corner& c : ring) {
      const Vec3 at = made_.position[c.vertex] - origin;
      corners.push_back({dot(at, right), dot(at, up)});
    }
    return is_turned_over(corners) || turns_back(corners) || crosses_itself(corners) ||
           (dented && has_dent(corners, kDeepDent));
  }

  // Returns the new place of a vertex half way to the middle of its neighbours.
  Touch step_of(int32_t v) const {
    const Vec3& here = made_.position[v];
    const Placing place = made_.place[v];
    const bool moves = place == Placing::crease || place == Placing::touching;
    if (!moves || follows_[v] >= 0) return {here};
    const auto middle = middle_of_neighbours(v, place);
    if (!middle) return {here};
    const Vec3 start = 0.5 * here + 0.5 * *middle;
    if (place == Placing::touching) return touch(v, walls_[v], start);
    const auto on_crease = samples_.creases().nearer(start, spacing_at(v));
    return {on_crease ? on_crease->point : here};
  }

  // A vertex on a crease has its neighbours on the rim, one of three walls those on the seam.
  std::optional<Vec3> middle_of_neighbours(int32_t v, Placing place) const {
    Vec3 sum;
    int count = 0;
    const auto take = [&](const Corner& c, int32_t other) {
      const int uses = edge_uses_[c.edge];
      const bool along = place == Placing::crease ? uses == 1 : walls_[v].count < 3 || uses == 3;
      if (!along) return;
      sum = sum + made_.position[other];
      ++count;
    };
    for_edges(v, take);
    if (count == 0) return {};
    return (1.0 / count) * sum;
  }

  // A vertex, and two samples that a facet without area separates there.
  using Hidden = std::array<int32_t, 3>;

  const InnerComplex& complex_;
  const Triangulation& t_;
  const SamplesOnFaces& samples_;
  std::span<const double> sine_;
  Run run_;
  Progress* progress_;
  std::vector<int32_t> facets_;  // those that get places
  Csr<int32_t> facets_at_;       // per vertex: the facets at it
  Array<uint8_t> edge_uses_;     // per edge: the facets at it; 3 means three or more
  Array<uint8_t> on_rim_;        // per vertex
  std::vector<Hidden> hidden_;
  PointTree corners_;
  std::vector<Vec3> corner_points_;
  CrispPlaces made_;
  Array<Walls> walls_;  // per vertex: what its ball touches
  // Per vertex: how far, and in which direction, a smooth rim is; 0 if there is none.
  struct SmoothRim {
    Vec3 outward;
    double reach = 0;
  };
  Array<SmoothRim> rim_;
  Array<int32_t> follows_;  // per vertex: the vertex in whose place it is, or -1
  std::vector<int32_t> followers_;
};

}  // namespace

CrispPlaces crisp_places(const InnerComplex& complex, const Triangulation& triangulation,
                         const SamplesOnFaces& samples, std::span<const Thickness> facets,
                         std::span<const double> sine, std::span<const uint8_t> selected,
                         const Run& run) {
  return CrispMaker(complex, triangulation, samples, facets, sine, selected, run).make();
}

}  // namespace medial
