// SPDX-License-Identifier: GPL-3.0-or-later
// Cocone by brute force, and what Tight Cocone makes of samples that are sparse, noisy or missing.
#include "cocone/cocone.h"

#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <random>

#include "axis/poles.h"
#include "cocone/peeling.h"
#include "cocone/solid.h"
#include "cocone/watertight_surface.h"
#include "delaunay/circumcentre.h"
#include "delaunay/samples.h"
#include "delaunay/triangulation.h"
#include "delaunay/voronoi.h"
#include "shapes.h"

namespace medial {
namespace {

constexpr Run kRun{1, nullptr};

// ---- The first step, restated ----------------------------------------------------------------

struct Diagram {
  Samples samples;
  Triangulation t;
  Voronoi v;
  Csr<int32_t> incident;
  Poles poles;

  explicit Diagram(std::span<const Vec3> rows)
      : samples(make_samples(rows, kRun)),
        t(triangulate(samples.points, kRun)),
        v(voronoi(samples.points, t, kRun)),
        incident(incident_cells(t, samples.count(), kRun)),
        poles(medial::poles(samples.points, t, v, incident, kRun)) {}
};

double angle(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(dot(a, b) / length(a) / length(b), -1.0, 1.0));
}

// A Voronoi edge or ray of a sample: its ends as seen from there, and the other corners of its
// triangle.
struct VoronoiEdge {
  Vec3 from, to;
  bool ray;  // `to` is a direction
  Triangle triangle;
};

std::vector<VoronoiEdge> edges_at(const Diagram& d, int32_t p) {
  std::vector<VoronoiEdge> edges;
  for (int32_t c = 0; c < d.t.finite_cells; ++c) {
    for (int i = 0; i < 4; ++i) {
      const int32_t across = d.t.neighbors[c][i];
      if (across < c) continue;  // from the other cell
      const Triangle triangle = corners(d.t, {c, i});
      if (std::find(triangle.begin(), triangle.end(), p) == triangle.end()) continue;
      const Vec3& here = d.samples.points[p];
      const bool ray = d.t.is_infinite(across);
      edges.push_back({d.v.centre[c] - here, ray ? d.v.centre[across] : d.v.centre[across] - here,
                       ray, triangle});
    }
  }
  return edges;
}

// Half-angle about the tangent plane: the edge misses the cocone when both its ends are steeper,
// on one side of the plane.
bool meets_cocone(const VoronoiEdge& e, const Vec3& normal, double half_angle) {
  const double steep = std::numbers::pi / 2 - half_angle;
  const auto is_above = [&](const Vec3& x) { return angle(x, normal) < steep; };
  const auto is_below = [&](const Vec3& x) { return angle(x, -normal) < steep; };
  return !(is_above(e.from) && is_above(e.to)) && !(is_below(e.from) && is_below(e.to));
}

bool is_thin(const std::vector<VoronoiEdge>& edges, const Vec3& normal, double ratio) {
  double width = 0, up = 0, down = 0;  // farthest crossing, farthest vertices above and below
  const auto reach = [&](const Vec3& x, double away) {
    double& height = dot(x, normal) > 0 ? up : down;
    height = std::max(height, away);
  };
  for (const VoronoiEdge& e : edges) {
    const double a = dot(e.from, normal), b = dot(e.to, normal);
    reach(e.from, length(e.from));
    reach(e.to, e.ray ? HUGE_VAL : length(e.to));
    if ((a >= 0) == (b >= 0)) continue;
    const Vec3 crossing =
        e.ray ? e.from - (a / b) * e.to : e.from + (a / (a - b)) * (e.to - e.from);
    width = std::max(width, length(crossing));
  }
  return ratio * width <= up && ratio * width <= down;
}

struct Restated {
  std::vector<uint8_t> thin, flat;
  std::set<Triangle> candidates;  // corners ascending
};

Restated restated(const Diagram& d, const CoconeOptions& options) {
  const int32_t count = d.samples.count();
  Restated result;
  std::vector<std::vector<VoronoiEdge>> edges;
  for (int32_t p = 0; p < count; ++p) edges.push_back(edges_at(d, p));
  const auto meets = [&](int32_t p, const VoronoiEdge& e) {
    return meets_cocone(e, d.poles.vector[p], options.cocone_angle);
  };
  // Per sample its neighbours in the cocone, and which of their normal lines agree.
  std::vector<std::set<int32_t>> neighbours(count), agreeing(count);
  for (int32_t p = 0; p < count; ++p) {
    for (const VoronoiEdge& e : edges[p]) {
      if (!meets(p, e)) continue;
      for (const int32_t q : e.triangle) {
        if (q == p) continue;
        neighbours[p].insert(q);
        const double between = angle(d.poles.vector[p], d.poles.vector[q]);
        if (std::min(between, std::numbers::pi - between) <= options.flatness_angle) {
          agreeing[p].insert(q);
        }
      }
    }
    result.thin.push_back(is_thin(edges[p], normalized(d.poles.vector[p]), options.flatness_ratio));
    result.flat.push_back(result.thin[p] && neighbours[p] == agreeing[p]);
  }
  for (bool grown = true; grown;) {
    grown = false;
    for (int32_t p = 0; p < count; ++p) {
      if (!result.thin[p] || result.flat[p]) continue;
      result.flat[p] = std::any_of(agreeing[p].begin(), agreeing[p].end(),
                                   [&](int32_t q) { return result.flat[q] != 0; });
      grown = grown || result.flat[p];
    }
  }
  std::map<Triangle, int> meetings;  // of flat corners
  for (int32_t p = 0; p < count; ++p) {
    for (const VoronoiEdge& e : edges[p]) {
      Triangle t = e.triangle;
      std::sort(t.begin(), t.end());
      if (result.flat[p]) meetings[t] += meets(p, e);
    }
  }
  for (const auto& [t, met] : meetings) {
    if (met == result.flat[t[0]] + result.flat[t[1]] + result.flat[t[2]]) {
      result.candidates.insert(t);
    }
  }
  return result;
}

void expect_same_cocone(const std::vector<Vec3>& rows, const CoconeOptions& options) {
  const Diagram d(rows);
  const Cocone c = cocone(d.samples.points, d.t, d.v, d.incident, d.poles, options, {2, nullptr});
  const Restated expected = restated(d, options);
  EXPECT_EQ(c.thin, expected.thin);
  EXPECT_EQ(c.flat, expected.flat);
  std::set<Triangle> candidates;
  for_faces(d.t, c.candidates, [&](const CellFace& f) {
    Triangle t = corners(d.t, f);
    std::sort(t.begin(), t.end());
    candidates.insert(t);
    EXPECT_TRUE(c.candidates.has(mirror(d.t, f)));
  });
  EXPECT_EQ(candidates, expected.candidates);
}

std::vector<Vec3> noisy(std::vector<Vec3> points, double size, uint32_t seed) {
  const auto noise = test::random_points(static_cast<int>(points.size()), seed);
  for (size_t i = 0; i < points.size(); ++i) points[i] = points[i] + size * noise[i];
  return points;
}

TEST(Cocone, IsAsRestated) {
  for (uint32_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_cocone(test::ellipsoid(150, seed), {});
    expect_same_cocone(noisy(test::ellipsoid(150, seed), 0.06, seed), {});
    expect_same_cocone(noisy(test::torus(16, 9).vertices, 0.1, seed), {});
    expect_same_cocone(test::random_points(80, seed), {.flatness_ratio = 0.7});
    expect_same_cocone(test::random_points(80, seed),
                       {.cocone_angle = 0.7, .flatness_ratio = 0.5, .flatness_angle = 0.7});
  }
}

// ---- The steps after it, restated ------------------------------------------------------------

// Everything up to the marks, of which the parts are compared with what their headers say.
struct Marked {
  Diagram d;
  Cocone cocone;
  FaceSet front;
  Marks marks;

  explicit Marked(const std::vector<Vec3>& rows)
      : d(rows),
        cocone(medial::cocone(d.samples.points, d.t, d.v, d.incident, d.poles, {}, kRun)),
        front(manifold(d.samples.points, d.t, d.incident, cocone, {}, kRun)),
        marks(mark(d.samples.points, d.t, d.v, d.incident, cocone, front, {}, kRun)) {}

  const std::vector<Vec3>& points() const { return d.samples.points; }
};

std::set<Triangle> triangles_of(const Triangulation& t, const FaceSet& set) {
  std::set<Triangle> found;
  for_faces(t, set, [&](const CellFace& f) {
    Triangle corners_of = corners(t, f);
    std::sort(corners_of.begin(), corners_of.end());
    found.insert(corners_of);
  });
  return found;
}

int32_t other_corner(const Triangle& t, int32_t p, int32_t q) { return t[0] + t[1] + t[2] - p - q; }

bool has(const Triangle& t, int32_t p) { return t[0] == p || t[1] == p || t[2] == p; }

// The normals of the triangles (p, q, x) and (q, p, y), oriented alike, are at most sharp_angle
// apart; seen along their edge, that is what their sides lack of half a turn.
bool continue_each_other(const Marked& m, int32_t p, int32_t q, int32_t x, int32_t y) {
  const auto aside = [&](int32_t v) {  // from the edge, at a right angle
    const Vec3 along = normalized(m.points()[q] - m.points()[p]),
               way = m.points()[v] - m.points()[p];
    return way - dot(way, along) * along;
  };
  return std::numbers::pi - angle(aside(x), aside(y)) <= CoconeOptions().sharp_angle;
}

// All triangles at p in one closed fan, in which neighbours continue each other.
bool is_simple_umbrella(const Marked& m, const std::set<Triangle>& set, int32_t p) {
  std::vector<Edge> links;
  for (const Triangle& t : set) {
    if (has(t, p)) links.push_back(link_of(t, p));
  }
  if (!put_in_cycle(links)) return false;
  for (size_t i = 0; i < links.size(); ++i) {
    const Edge &here = links[i], &next = links[(i + 1) % links.size()];
    if (!continue_each_other(m, p, here[1], here[0], next[1])) return false;
  }
  return true;
}

// Candidates without those at sharp edges: no other triangle there continues one. Edges of two
// samples that are not flat are exempt, triangles of simple umbrellas stay.
std::set<Triangle> pruned(const Marked& m, std::set<Triangle>& locked) {
  auto set = triangles_of(m.d.t, m.cocone.candidates);
  for (int32_t p = 0; p < m.d.samples.count(); ++p) {
    if (!is_simple_umbrella(m, set, p)) continue;
    for (const Triangle& t : set) {
      if (has(t, p)) locked.insert(t);
    }
  }
  const auto is_sharp = [&](int32_t p, int32_t q) {
    std::vector<int32_t> thirds;
    for (const Triangle& t : set) {
      if (has(t, p) && has(t, q)) thirds.push_back(other_corner(t, p, q));
    }
    for (const int32_t x : thirds) {
      for (const int32_t y : thirds) {
        if (x < y && continue_each_other(m, p, q, x, y)) return false;
      }
    }
    return true;
  };
  const auto is_to_go = [&](const Triangle& t) {
    if (locked.count(t)) return false;
    for (const int32_t corner : t) {
      const auto [p, q] = link_of(t, corner);
      if ((m.cocone.flat[p] || m.cocone.flat[q]) && is_sharp(p, q)) return true;
    }
    return false;
  };
  while (std::erase_if(set, is_to_go) > 0) {
  }
  return set;
}

// The surface is of triangles that the pruning left, of at most two at an edge, which pass it in
// opposite directions. Adds up the triangles of simple umbrellas: `lost` are those that it lacks.
void expect_pruned_and_oriented(const Marked& m, int64_t& kept, int64_t& lost) {
  std::set<Triangle> locked;
  const auto surface = triangles_of(m.d.t, m.front), left = pruned(m, locked);
  EXPECT_TRUE(std::includes(left.begin(), left.end(), surface.begin(), surface.end()));
  for (const Triangle& t : locked) lost += !surface.count(t);
  kept += static_cast<int64_t>(locked.size());
  std::map<Edge, int> uses;  // directed
  for_faces(m.d.t, m.front, [&](const CellFace& f) {
    const Triangle t = corners(m.d.t, f);
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  });
  for (const auto& [edge, count] : uses) EXPECT_EQ(count, 1);
}

// Above 0: the pole of a sample lies in front of it, by most of its cells; 0: its marks do not
// tell.
int pole_in_front(const Marked& m, int32_t p) {
  int votes = 0;
  for (const int32_t c : m.d.incident[p]) {
    const Vec3 way = towards(m.points()[p], m.d.t, m.d.v, c);
    const Facing facing = m.marks.facing[c][slot_of(m.d.t.cells[c], p)];
    const double steep = std::numbers::pi / 2 - CoconeOptions().cocone_angle;
    const double to_pole = angle(way, m.cocone.normal[p]);
    if (to_pole < steep) votes += facing == Facing::front ? 1 : -1;
    if (std::numbers::pi - to_pole < steep) votes += facing == Facing::back ? 1 : -1;
  }
  return votes;
}

// Patches: good samples that the surface connects, then flat ones that share a candidate triangle
// and whose normal lines agree, the best agreement first. Wherever that joins two patches, the
// fronts of the two samples lie on the same side.
void expect_patches_joined_where_they_agree_best(const Marked& m) {
  std::vector<int32_t> patch(m.marks.good.size());
  std::iota(patch.begin(), patch.end(), 0);
  const auto join = [&](int32_t p, int32_t q) {
    const int32_t low = std::min(patch[p], patch[q]), high = std::max(patch[p], patch[q]);
    std::replace(patch.begin(), patch.end(), high, low);
  };
  for (const Triangle& t : triangles_of(m.d.t, m.front)) {
    for (const int32_t corner : t) {
      const auto [p, q] = link_of(t, corner);
      if (m.marks.good[p] && m.marks.good[q]) join(p, q);
    }
  }
  std::set<std::tuple<double, int32_t, int32_t>> pairs;
  for (const Triangle& t : triangles_of(m.d.t, m.cocone.candidates)) {
    for (const int32_t corner : t) {
      const auto [x, y] = link_of(t, corner);
      const int32_t p = std::min(x, y), q = std::max(x, y);
      if (!m.cocone.flat[p] || !m.cocone.flat[q] || (m.marks.good[p] && m.marks.good[q])) continue;
      const double cosine = dot(m.cocone.normal[p], m.cocone.normal[q]);
      if (std::abs(cosine) >= std::cos(CoconeOptions().flatness_angle)) {
        pairs.insert({-std::abs(cosine), p, q});
      }
    }
  }
  for (const auto& [agreement, p, q] : pairs) {
    if (patch[p] == patch[q]) continue;
    join(p, q);
    const bool opposite = dot(m.cocone.normal[p], m.cocone.normal[q]) < 0;
    const int at_p = pole_in_front(m, p), at_q = pole_in_front(m, q);
    if (at_p != 0 && at_q != 0) {
      EXPECT_EQ((at_p > 0) != (at_q > 0), opposite) << p << " " << q;
    }
  }
  EXPECT_EQ(patch, m.marks.patch);
}

// Peeling with plain lists: cells that most of the corners that know see outside are taken; where
// none knows, the largest opening is passed when nothing else is left to do.
class SlowPeeling {
 public:
  explicit SlowPeeling(const Marked& m)
      : m_(m), outside_(m.d.t.cells.size(), 0), outer_(m.marks.good.size(), Facing::none) {
    for (int32_t c = m.d.t.finite_cells; c < m.d.t.cell_count(); ++c) take(c);
    while (!taken_.empty() || !openings_.empty()) {
      if (taken_.empty()) {
        pass_largest();
      } else {
        leave();
      }
    }
  }
  bool is_outside(int32_t cell) const { return outside_[cell] != 0; }

 private:
  double size_of(const CellFace& f) const {
    const auto [p, q, r] = corners(m_.d.t, f);
    return squared_circumradius(m_.points()[p], m_.points()[q], m_.points()[r]);
  }
  std::vector<Facing> votes(int32_t cell) const {  // front: for outside
    std::vector<Facing> found;
    for (int i = 0; i < 4; ++i) {
      const int32_t p = m_.d.t.cells[cell][i];
      const Facing facing = p < 0 ? Facing::none : m_.marks.facing[cell][i];
      if (facing == Facing::none || outer_[m_.marks.patch[p]] == Facing::none) continue;
      found.push_back(facing == outer_[m_.marks.patch[p]] ? Facing::front : Facing::back);
    }
    return found;
  }
  bool is_for_outside(const std::vector<Facing>& votes) const {
    return 2 * std::count(votes.begin(), votes.end(), Facing::front) >
           static_cast<int64_t>(votes.size());
  }
  // Into a cell that no corner will ever know it is not passed through the smallest face.
  bool is_passable(const CellFace& from) const {
    const CellFace f = mirror(m_.d.t, from);
    const auto& facing = m_.marks.facing[f.cell];
    if (std::any_of(facing.begin(), facing.end(), [](Facing x) { return x != Facing::none; })) {
      return true;
    }
    double least = HUGE_VAL;
    for (int i = 0; i < 4; ++i) least = std::min(least, size_of({f.cell, i}));
    return size_of(f) > least * (1 + 0x1p-20);
  }

  void take(int32_t cell) {
    outside_[cell] = 1;
    taken_.push_back(cell);
    for (int i = 0; i < 4; ++i) {
      const Facing facing = m_.marks.facing[cell][i];
      if (facing == Facing::none) continue;
      Facing& outer = outer_[m_.marks.patch[m_.d.t.cells[cell][i]]];
      if (outer == Facing::none) outer = facing;
    }
  }
  void leave() {
    const int32_t cell = taken_.back();
    taken_.pop_back();
    for (int i = 0; i < 4; ++i) {
      const int32_t next = m_.d.t.neighbors[cell][i];
      if (outside_[next]) continue;
      const auto said = votes(next);
      if (is_for_outside(said)) take(next);
      if (said.empty() && is_passable({cell, i})) openings_.push_back({cell, i});
    }
  }
  void pass_largest() {
    const auto largest = std::max_element(
        openings_.begin(), openings_.end(), [&](const CellFace& a, const CellFace& b) {
          return std::tuple(size_of(a), a.cell, a.slot) < std::tuple(size_of(b), b.cell, b.slot);
        });
    const int32_t next = m_.d.t.neighbors[largest->cell][largest->slot];
    openings_.erase(largest);
    const auto said = votes(next);
    if (!outside_[next] && (said.empty() || is_for_outside(said))) take(next);
  }

  const Marked& m_;
  std::vector<uint8_t> outside_;
  std::vector<Facing> outer_;
  std::vector<int32_t> taken_;
  std::vector<CellFace> openings_;
};

void expect_same_peeling(const Marked& m) {
  const SlowPeeling expected(m);
  const TightCocone found =
      tight_cocone(m.points(), m.d.t, m.d.v, m.d.incident, m.d.poles, {}, {2, nullptr});
  for (int32_t c = 0; c < m.d.t.cell_count(); ++c) {
    EXPECT_EQ(static_cast<Side>(found.sides[c]) != Side::inner, expected.is_outside(c)) << c;
  }
  EXPECT_EQ(found.good, m.marks.good);
}

TEST(TightCocone, JoinsPatchesWhereTheyAgreeBest) {
  for (uint32_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_patches_joined_where_they_agree_best(
        Marked(noisy(test::torus(60, 30).vertices, 0.05, seed)));
    expect_patches_joined_where_they_agree_best(
        Marked(noisy(test::ellipsoid(1500, seed), 0.03, seed)));
  }
}

TEST(TightCocone, PrunesMarksAndPeelsAsRestated) {
  int64_t kept = 0, lost = 0;
  for (uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const auto& rows :
         {test::ellipsoid(150, seed), noisy(test::ellipsoid(300, seed), 0.05, seed),
          noisy(test::torus(24, 12).vertices, 0.08, seed),
          noisy(test::ellipsoid(300, seed), 0.15, seed), test::random_points(150, seed)}) {
      const Marked m(rows);
      expect_pruned_and_oriented(m, kept, lost);
      expect_patches_joined_where_they_agree_best(m);
      expect_same_peeling(m);
    }
    if (HasFailure()) return;
  }
  // The walk over the surface drops few triangles whose place is clear.
  EXPECT_GT(kept, 4000);
  EXPECT_LT(lost, kept / 50);
}

// ---- The surface -----------------------------------------------------------------------------

WatertightSurface surface_of(std::span<const Vec3> rows) { return watertight_surface(rows, {}, 2); }

// Every edge twice, once in each direction.
void expect_watertight(const WatertightSurface& surface) {
  std::map<Edge, int> balance;
  for (const Triangle& t : surface.triangles) {
    for (const int32_t corner : t) {
      const auto [p, q] = link_of(t, corner);
      balance[{std::min(p, q), std::max(p, q)}] += p < q ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0);
}

// Where the solid is pinched: edges of more than two triangles, and vertices whose triangles are
// not one disc, counted from the triangles alone.
TEST(TightCocone, CountsWhereItsSurfaceIsNoManifold) {
  int64_t all_edges = 0;
  for (uint32_t seed = 0; seed < 5; ++seed) {
    const WatertightSurface surface = surface_of(noisy(test::ellipsoid(600, seed), 0.06, seed));
    int64_t edges = 0, vertices = 0;
    for (const auto& [edge, uses] : test::edge_uses(surface.triangles)) edges += uses > 2;
    for (int32_t p = 0; p < 600; ++p) {
      std::vector<Edge> links;
      for (const Triangle& t : surface.triangles) {
        if (has(t, p)) links.push_back(link_of(t, p));
      }
      vertices += !links.empty() && !put_in_cycle(links);
    }
    EXPECT_EQ(surface.nonmanifold_edges, edges);
    EXPECT_EQ(surface.nonmanifold_vertices, vertices);
    expect_watertight(surface);
    all_edges += edges;
  }
  EXPECT_GT(all_edges, 20);
}

}  // namespace
}  // namespace medial
