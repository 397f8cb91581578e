// SPDX-License-Identifier: GPL-3.0-or-later
// The library against the brute-force restatement of MEDIAL in oracle.h: poles, umbrellas, theta,
// rho, selection, Definition 4, facets and sides, on random and on degenerate inputs.
#include <gtest/gtest.h>
#include <medial/analysis.h>
#include <medial/sampling.h>

#include <functional>
#include <random>

#include "axis/poles.h"
#include "axis/umbrellas.h"
#include "delaunay/samples.h"
#include "delaunay/triangulation.h"
#include "delaunay/voronoi.h"
#include "inside/buried.h"
#include "oracle.h"
#include "shapes.h"

namespace medial {
namespace {

using test::GridPoint;
using test::Ids;
using test::Oracle;
using test::Real;

constexpr double kPi = std::numbers::pi;
constexpr double kGrid = 0x1p-19;  // one step of the coordinates of inputs in general position
constexpr Thresholds kAll{.theta = 0, .rho = 0};

// ---- Inputs ----------------------------------------------------------------------------------

struct Cloud {
  std::vector<GridPoint> points;  // distinct
  double step = kGrid;
  bool symmetric = false;  // as in Oracle

  std::vector<Vec3> rows() const {
    std::vector<Vec3> result;
    for (const GridPoint& p : points) {
      result.push_back({step * static_cast<double>(p.x), step * static_cast<double>(p.y),
                        step * static_cast<double>(p.z)});
    }
    return result;
  }
};

// Rounds to the grid; equal points are there once.
Cloud rounded(std::span<const Vec3> points) {
  Cloud cloud{{}, kGrid};
  std::set<GridPoint> known;
  for (const Vec3& p : points) {
    const GridPoint g{std::llround(p.x / kGrid), std::llround(p.y / kGrid),
                      std::llround(p.z / kGrid)};
    if (known.insert(g).second) cloud.points.push_back(g);
  }
  return cloud;
}

std::vector<Vec3> gaussian(int count, uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 0.2);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {normal(random), normal(random), normal(random)};
  return points;
}

std::vector<Vec3> on_torus(int count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0, 2 * kPi);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    const double u = angle(random), v = angle(random), r = 0.6 + 0.3 * std::cos(v);
    p = {r * std::cos(u), r * std::sin(u), 0.3 * std::sin(v)};
  }
  return points;
}

// No five of them on one empty sphere.
bool general_position(const std::set<Ids>& spheres) {
  return std::all_of(spheres.begin(), spheres.end(), [](const Ids& s) { return s.size() == 4; });
}

// The finite cells of the library's triangulation, corners as rows.
std::set<Ids> library_cells(std::span<const Vec3> rows) {
  const Samples samples = make_samples(rows, {1, nullptr});
  const Triangulation t = triangulate(samples.points, {1, nullptr});
  std::set<Ids> cells;
  for (int32_t c = 0; c < t.finite_cells; ++c) {
    Ids cell;
    for (const int32_t id : t.cells[c]) cell.push_back(samples.row[id]);
    std::sort(cell.begin(), cell.end());
    cells.insert(cell);
  }
  return cells;
}

MedialAnalysis analysis_of(std::span<const Vec3> rows) {
  return MedialAnalysis({rows}, {.sides = SidesFrom::none, .threads = 1}, nullptr);
}

// ---- What is compared ------------------------------------------------------------------------

bool settled(const Oracle& oracle, const Edge& pq) {
  return oracle.settled(pq[0]) && oracle.settled(pq[1]);
}

// The largest circumradius in the umbrella of each sample; here row i is sample i.
void expect_same_spacing(const MedialAnalysis& analysis, const Oracle& oracle) {
  const auto spacing = analysis.spacing();
  for (int32_t p = 0; p < static_cast<int32_t>(spacing.size()); ++p) {
    if (!oracle.settled(p)) continue;
    const auto expected = static_cast<double>(oracle.umbrella_radius(p));
    EXPECT_NEAR(spacing[p], expected, 1e-7 * expected);
  }
}

// Returns how many edges have ends that the definitions do not settle.
int expect_same_values(const MedialAnalysis& analysis, const Oracle& oracle) {
  const auto edges = analysis.edge_rows();
  EXPECT_EQ(std::set<Edge>(edges.begin(), edges.end()), oracle.edges());
  EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
  const auto theta = analysis.theta(Rule::either), theta_both = analysis.theta(Rule::both);
  const auto rho = analysis.rho(Rule::either), rho_both = analysis.rho(Rule::both);
  const auto bounded = analysis.edges_bounded();
  expect_same_spacing(analysis, oracle);
  int unsettled = 0;
  for (size_t e = 0; e < edges.size(); ++e) {
    const auto [p, q] = edges[e];
    EXPECT_EQ(bounded[e] != 0, oracle.is_bounded(edges[e])) << p << " " << q;
    if (!settled(oracle, edges[e])) {
      ++unsettled;
      continue;
    }
    const auto at_p = oracle.end(p, q), at_q = oracle.end(q, p);
    EXPECT_NEAR(theta[e], std::max(at_p.theta, at_q.theta), 1e-7) << p << " " << q;
    EXPECT_NEAR(theta_both[e], std::min(at_p.theta, at_q.theta), 1e-7) << p << " " << q;
    EXPECT_NEAR(rho[e], std::max(at_p.rho, at_q.rho), 1e-7 * rho[e]) << p << " " << q;
    EXPECT_NEAR(rho_both[e], std::min(at_p.rho, at_q.rho), 1e-7 * rho_both[e]) << p << " " << q;
  }
  return unsettled;
}

// Whether MEDIAL selects an edge; nothing where a value is too close to its threshold to tell.
std::optional<bool> is_selected(const Oracle& oracle, const Edge& pq, const Extraction& x) {
  const Thresholds& t = x.thresholds;
  std::array<bool, 2> angle, ratio;
  for (const int i : {0, 1}) {
    const auto end = oracle.end(pq[i], pq[1 - i]);
    if (std::abs(end.theta - t.theta) < 1e-7 || std::abs(end.rho - t.rho) < 1e-7 * end.rho) {
      return {};
    }
    angle[i] = end.tried && end.theta > t.theta && t.criteria != Criteria::ratio;
    ratio[i] = end.tried && end.rho > t.rho && t.criteria != Criteria::angle;
  }
  const auto by_rule = [&](const std::array<bool, 2>& ends) {
    return t.rule == Rule::both ? ends[0] && ends[1] : ends[0] || ends[1];
  };
  if (by_rule(angle)) return true;
  if (!by_rule(ratio)) return false;
  return !x.limit_set || oracle.in_limit_set(pq, t.rule == Rule::both);
}

void expect_same_selection(const MedialAnalysis& analysis, const Oracle& oracle,
                           const Extraction& x) {
  const auto edges = analysis.edge_rows();
  const auto ids = analysis.select(x);
  std::vector<uint8_t> chosen(edges.size(), 0);
  for (const int32_t id : ids) chosen[id] = 1;
  for (size_t e = 0; e < edges.size(); ++e) {
    if (!settled(oracle, edges[e])) continue;
    const auto expected = is_selected(oracle, edges[e], x);
    if (expected) {
      EXPECT_EQ(chosen[e] != 0, *expected)
          << edges[e][0] << " " << edges[e][1] << " theta " << x.thresholds.theta << " rho "
          << x.thresholds.rho << " rule " << static_cast<int>(x.thresholds.rule) << " criteria "
          << static_cast<int>(x.thresholds.criteria) << " limit set " << x.limit_set;
    }
  }
}

void expect_same_selections(const MedialAnalysis& analysis, const Oracle& oracle) {
  for (const Rule rule : {Rule::either, Rule::both}) {
    for (const Criteria criteria : {Criteria::angle_or_ratio, Criteria::angle, Criteria::ratio}) {
      expect_same_selection(
          analysis, oracle,
          {.thresholds = {.theta = 0, .rho = 0, .rule = rule, .criteria = criteria}});
      expect_same_selection(analysis, oracle, {.thresholds = {.rule = rule, .criteria = criteria}});
      for (const double rho : {0.7, 1.6, 3.0}) {
        expect_same_selection(
            analysis, oracle,
            {.thresholds = {.theta = 0.9, .rho = rho, .rule = rule, .criteria = criteria},
             .limit_set = true});
      }
    }
  }
}

// The polygon of a facet against the Voronoi vertices that the oracle has in order.
void expect_same_polygon(const MedialMesh& mesh, size_t f, const Oracle& oracle, const Ids& facet) {
  const int32_t begin = mesh.face_offsets[f], size = mesh.face_offsets[f + 1] - begin;
  ASSERT_EQ(static_cast<size_t>(size), facet.size());
  const auto away = [&](int32_t corner, size_t i) {
    const Real c = oracle.centre(facet[i % facet.size()]);
    const Vec3& v = mesh.vertices[mesh.face_vertices[begin + corner]];
    return static_cast<double>(test::length(c - Real{v.x, v.y, v.z}));
  };
  size_t start = 0;
  for (size_t i = 0; i < facet.size(); ++i) {
    if (away(0, i) < away(0, start)) start = i;
  }
  for (int32_t i = 0; i < size; ++i) {
    const auto vertex = mesh.face_vertices[begin + i];
    const auto radius = static_cast<double>(oracle.radius(facet[(start + i) % facet.size()]));
    const double error = 0x1p-23 * radius + 0x1p-50 * max_abs(mesh.vertices[vertex]);
    EXPECT_LE(away(i, start + static_cast<size_t>(i)), error) << "corner " << i;
    EXPECT_NEAR(mesh.radius[vertex], radius, error);
    EXPECT_LE(mesh.face_vertices[begin], vertex) << "the lowest comes first";
  }
}

// Vertices are numbered in the order in which the facets use them.
void expect_numbered_by_first_use(const MedialMesh& mesh) {
  int32_t known = 0;
  for (size_t f = 0; f + 1 < mesh.face_offsets.size(); ++f) {
    std::set<int32_t> added;
    for (int32_t i = mesh.face_offsets[f]; i < mesh.face_offsets[f + 1]; ++i) {
      if (mesh.face_vertices[i] >= known) added.insert(mesh.face_vertices[i]);
    }
    if (!added.empty()) {
      EXPECT_EQ(*added.begin(), known);
      EXPECT_EQ(*added.rbegin(), known + static_cast<int32_t>(added.size()) - 1);
    }
    known += static_cast<int32_t>(added.size());
  }
  EXPECT_EQ(mesh.vertices.size(), static_cast<size_t>(known));
  EXPECT_EQ(mesh.radius.size(), static_cast<size_t>(known));
}

// The facets are those of the selected edges that are bounded and have an area, in their order.
void expect_same_facets(const MedialAnalysis& analysis, const Oracle& oracle, const Extraction& x) {
  const auto edges = analysis.edge_rows();
  const auto theta = analysis.theta(x.thresholds.rule), rho = analysis.rho(x.thresholds.rule);
  const MedialMesh mesh = analysis.extract(x);
  size_t f = 0;
  int64_t unbounded = 0, zero_area = 0;
  for (const int32_t e : analysis.select(x)) {
    if (!oracle.is_bounded(edges[e])) {
      ++unbounded;
      continue;
    }
    const Ids facet = oracle.facet(edges[e]);
    if (facet.size() < 3) {
      ++zero_area;
      continue;
    }
    ASSERT_LT(f, mesh.generators.size());
    ASSERT_EQ(mesh.generators[f], edges[e]);
    EXPECT_EQ(mesh.theta[f], theta[e]);
    EXPECT_EQ(mesh.rho[f], rho[e]);
    expect_same_polygon(mesh, f, oracle, facet);
    ++f;
  }
  EXPECT_EQ(f, mesh.generators.size());
  EXPECT_EQ(mesh.unbounded, unbounded);
  EXPECT_EQ(mesh.zero_area, zero_area);
  expect_numbered_by_first_use(mesh);
}

// A threshold is exceeded, not reached: a value as its own threshold does not select its edge, the
// next lower double does.
void expect_strict_thresholds(const MedialAnalysis& analysis) {
  const auto theta = analysis.theta(Rule::either), rho = analysis.rho(Rule::either);
  const auto selects = [&](int32_t e, double theta0, double rho0, Criteria criteria) {
    const auto ids =
        analysis.select({.thresholds = {.theta = theta0, .rho = rho0, .criteria = criteria}});
    return std::binary_search(ids.begin(), ids.end(), e);
  };
  for (int32_t e = 0; e < static_cast<int32_t>(theta.size()); e += 7) {
    // Then the end with the larger value is tried: pq is in no triangle of its umbrella.
    if (theta[e] < 1e-6 || rho[e] < 2.001) continue;
    EXPECT_FALSE(selects(e, theta[e], HUGE_VAL, Criteria::angle));
    EXPECT_TRUE(selects(e, std::nextafter(theta[e], 0), HUGE_VAL, Criteria::angle));
    EXPECT_FALSE(selects(e, kPi / 2, rho[e], Criteria::ratio));
    EXPECT_TRUE(selects(e, kPi / 2, std::nextafter(rho[e], 0), Criteria::ratio));
  }
}

// Poles and umbrellas as the stages give them, ids as rows.
void expect_same_stages(const std::vector<Vec3>& rows, const Oracle& oracle) {
  const Run run{1, nullptr};
  const Samples samples = make_samples(rows, run);
  const Triangulation t = triangulate(samples.points, run);
  const Voronoi v = voronoi(samples.points, t, run);
  const auto incident = incident_cells(t, samples.count(), run);
  const Poles p = poles(samples.points, t, v, incident, run);
  const Umbrellas u = umbrellas(samples.points, t, v, incident, run);
  for (int32_t id = 0; id < samples.count(); ++id) {
    const int32_t row = samples.row[id];
    EXPECT_EQ(p.unbounded[id] != 0, oracle.pole_at_infinity(row));
    if (!oracle.settled(row)) continue;
    const Vec3& found = p.vector[id];
    const Real pole = oracle.pole_vector(row);
    EXPECT_LT(test::length(pole - Real{found.x, found.y, found.z}), 1e-6L * test::length(pole));
    std::set<Edge> links;
    for (const auto& [a, b] : u[id]) {
      links.insert(
          {std::min(samples.row[a], samples.row[b]), std::max(samples.row[a], samples.row[b])});
    }
    EXPECT_EQ(links, oracle.umbrella(row)) << row;
  }
}

// All of it. Returns the share of the edges that the definitions do not settle.
double expect_same(const Cloud& cloud, const std::set<Ids>& cells) {
  const Oracle oracle(cloud.points, cloud.step, cells, cloud.symmetric);
  const auto rows = cloud.rows();
  const MedialAnalysis analysis = analysis_of(rows);
  const int unsettled = expect_same_values(analysis, oracle);
  expect_same_selections(analysis, oracle);
  for (const Rule rule : {Rule::either, Rule::both}) {
    expect_same_facets(analysis, oracle, {.thresholds = {.theta = 0, .rho = 0, .rule = rule}});
    expect_same_facets(analysis, oracle,
                       {.thresholds = {.theta = 0.6, .rho = 1.5, .rule = rule}, .limit_set = true});
  }
  expect_strict_thresholds(analysis);
  expect_same_stages(rows, oracle);
  return unsettled / static_cast<double>(oracle.edges().size());
}

void expect_same_in_general_position(const std::function<std::vector<Vec3>(int, uint32_t)>& points,
                                     int count, uint32_t seeds) {
  double unsettled = 0;
  for (uint32_t seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Cloud cloud = rounded(points(count, seed));
    cloud.step = std::ldexp(kGrid, static_cast<int>(seed % 7) * 30 - 90);  // nothing is absolute
    const auto spheres = test::empty_spheres(cloud.points);
    ASSERT_TRUE(general_position(spheres));
    unsettled += expect_same(cloud, spheres);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_LT(unsettled / seeds, 0.01);
}

TEST(Method, OnGaussianPoints) { expect_same_in_general_position(gaussian, 24, 60); }
TEST(Method, OnEllipsoids) { expect_same_in_general_position(test::ellipsoid, 30, 50); }
TEST(Method, OnTori) { expect_same_in_general_position(on_torus, 32, 50); }

// ---- Degenerate inputs -----------------------------------------------------------------------
//
// Cospherical points have several Delaunay triangulations, and umbrellas, theta and rho are those
// of the one that was made. So the oracle takes the cells of the library, after they were proved to
// be a Delaunay triangulation, and compares all but ties of the farthest vertex and vertices in a
// tangent plane. What does not depend on the triangulation, the true facets with an area, is
// compared with the maximal empty spheres, which the oracle finds by itself.

std::vector<GridPoint> some_of(std::vector<GridPoint> points, size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  for (size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random() % i]);
  points.resize(std::min(count, points.size()));
  return points;
}

std::vector<GridPoint> lattice(int n, const GridPoint& spacing = {1, 1, 1}) {
  std::vector<GridPoint> points;
  for (int64_t x = 0; x < n; ++x) {
    for (int64_t y = 0; y < n; ++y) {
      for (int64_t z = 0; z < n; ++z) {
        points.push_back({x * spacing.x, y * spacing.y, z * spacing.z});
      }
    }
  }
  return points;
}

std::vector<GridPoint> octahedron(int64_t r) {
  return {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
}

std::vector<GridPoint> on_sphere(int64_t squared_radius) {
  std::vector<GridPoint> points;
  for (int64_t x = -9; x <= 9; ++x) {
    for (int64_t y = -9; y <= 9; ++y) {
      for (int64_t z = -9; z <= 9; ++z) {
        if (x * x + y * y + z * z == squared_radius) points.push_back({x, y, z});
      }
    }
  }
  return points;
}

// Rings of points of one circle, one above the other.
std::vector<GridPoint> prism(int rings, int64_t height) {
  std::vector<GridPoint> points;
  for (int64_t z = 0; z < rings; ++z) {
    for (int64_t x = -5; x <= 5; ++x) {
      for (int64_t y = -5; y <= 5; ++y) {
        if (x * x + y * y == 25) points.push_back({x, y, z * height});
      }
    }
  }
  return points;
}

std::vector<GridPoint> layers(int64_t gap) {
  std::vector<GridPoint> points;
  for (const GridPoint& p : lattice(4)) {
    if (p.z < 2) points.push_back({p.x, p.y, p.z * gap});
  }
  return points;
}

bool spans_a_volume(const std::vector<GridPoint>& p) {
  for (size_t i = 3; i < p.size(); ++i) {
    for (size_t j = 1; j < i; ++j) {
      for (size_t k = 1; k < j; ++k) {
        if (test::orientation(p[0], p[i], p[j], p[k]) != 0) return true;
      }
    }
  }
  return false;
}

// The facets with an area, as sets of Voronoi vertices: intersections of two Voronoi cells with
// three vertices or more. Two distinct ones would be the ends of a Voronoi edge.
void expect_true_facets(const Cloud& cloud, const Oracle& oracle) {
  const auto spheres = test::empty_spheres(cloud.points);
  const auto rows = cloud.rows();
  const MedialAnalysis analysis = analysis_of(rows);
  const MedialMesh mesh = analysis.extract({.thresholds = kAll});
  std::map<Edge, size_t> vertices;  // of the intersection of two cells
  for (const Ids& sphere : spheres) {
    for (const int32_t p : sphere) {
      for (const int32_t q : sphere) {
        if (p < q) ++vertices[{p, q}];
      }
    }
  }
  const auto has_area = [&](const Edge& pq) { return vertices[pq] >= 3 && oracle.is_bounded(pq); };
  std::set<Edge> selected, emitted(mesh.generators.begin(), mesh.generators.end());
  const auto edges = analysis.edge_rows();
  for (const int32_t e : analysis.select({.thresholds = kAll})) selected.insert(edges[e]);
  for (const auto& [pq, count] : vertices) {
    if (count >= 3) {
      EXPECT_TRUE(std::binary_search(edges.begin(), edges.end(), pq));
    }
    EXPECT_EQ(emitted.count(pq) != 0, has_area(pq) && selected.count(pq)) << pq[0] << " " << pq[1];
  }
  for (size_t f = 0; f < mesh.generators.size(); ++f) {
    EXPECT_EQ(static_cast<size_t>(mesh.face_offsets[f + 1] - mesh.face_offsets[f]),
              vertices[mesh.generators[f]]);
  }
}

void expect_same_though_degenerate(const Cloud& cloud) {
  const auto cells = library_cells(cloud.rows());
  const Oracle oracle(cloud.points, cloud.step, cells, cloud.symmetric);
  ASSERT_TRUE(oracle.is_delaunay());
  expect_same(cloud, cells);
  expect_true_facets(cloud, oracle);
}

TEST(Method, OnPartsOfDegenerateShapes) {
  const std::vector<std::vector<GridPoint>> shapes{
      lattice(3),    lattice(4),  lattice(3, {3, 4, 5}), on_sphere(81), on_sphere(50),
      on_sphere(29), prism(3, 4), prism(2, 10),          layers(1),     layers(3)};
  for (size_t shape = 0; shape < shapes.size(); ++shape) {
    for (uint32_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE("shape " + std::to_string(shape) + " seed " + std::to_string(seed));
      const Cloud cloud{some_of(shapes[shape], 8 + seed, seed), 0.125};
      if (spans_a_volume(cloud.points)) expect_same_though_degenerate(cloud);
      if (HasFailure()) return;
    }
  }
}

TEST(Method, OnWholeDegenerateShapes) {
  auto centred = octahedron(2);
  centred.push_back({0, 0, 0});
  std::vector<GridPoint> hollow;
  for (const GridPoint& p : lattice(3)) {
    if (!(p == GridPoint{1, 1, 1})) hollow.push_back(p);
  }
  for (const auto& points : {lattice(2), lattice(3), hollow, octahedron(1), centred, prism(3, 4)}) {
    SCOPED_TRACE(std::to_string(points.size()) + " points");
    expect_same_though_degenerate({points, 1});
  }
}

// Coplanar clusters: faces of a box whose samples lie at random in them.
TEST(Method, OnRandomPointsOfACube) {
  for (uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::vector<Vec3> points = test::random_points(26, seed);
    for (Vec3& p : points) (&p.x)[random() % 3] = random() % 2 ? 0.75 : -0.75;
    expect_same_though_degenerate(rounded(points));
    if (HasFailure()) return;
  }
}

// Voronoi vertices that lie exactly in the tangent plane of the middle sample of the upper layer
// count as above it: a square grid, below the middles of its edges points of the spheres about the
// middles of its squares.
TEST(Method, AVoronoiVertexInTheTangentPlaneCountsAsAbove) {
  Cloud cloud{{}, 0.5, true};
  for (int64_t x = 0; x < 3; ++x) {
    for (int64_t y = 0; y < 3; ++y) cloud.points.push_back({2 * x, 2 * y, 0});
  }
  for (int64_t x = 0; x < 5; ++x) {
    for (int64_t y = 0; y < 5; ++y) {
      if ((x + y) % 2) cloud.points.push_back({x, y, -1});
    }
  }
  const auto cells = library_cells(cloud.rows());
  const Oracle oracle(cloud.points, cloud.step, cells, true);
  ASSERT_TRUE(oracle.is_delaunay());
  ASSERT_TRUE(oracle.settled(4));
  ASSERT_TRUE(oracle.pole_at_infinity(4));
  expect_same_stages(cloud.rows(), oracle);
  for (const Edge& link : oracle.umbrella(4)) {
    EXPECT_TRUE(link[0] >= 9 || link[1] >= 9) << "a triangle of the hull";
  }
}

// Samples of a sphere are cospherical up to the rounding of their coordinates: all cells have one
// Voronoi vertex, and no facet has an area.
TEST(Method, SamplesOfASphereHaveNoFacets) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    std::vector<Vec3> rows = gaussian(30, seed);
    for (Vec3& p : rows) p = Vec3{3, 4, 5} + normalized(p);
    const MedialMesh mesh = analysis_of(rows).extract({.thresholds = kAll});
    EXPECT_EQ(mesh.generators.size(), 0u) << seed;
    EXPECT_GT(mesh.zero_area, 0);
  }
}

// If several Voronoi vertices are equally far, the vertex of the lowest cell is the pole.
TEST(Method, OfEquallyFarVerticesTheLowestIsThePole) {
  const auto rows = Cloud{lattice(4), 1}.rows();
  const medial::Run run{1, nullptr};
  const Samples samples = make_samples(rows, run);
  const Triangulation t = triangulate(samples.points, run);
  const Voronoi v = voronoi(samples.points, t, run);
  const auto incident = incident_cells(t, samples.count(), run);
  const Poles p = poles(samples.points, t, v, incident, run);
  int bounded = 0;
  for (int32_t id = 0; id < samples.count(); ++id) {
    if (p.unbounded[id]) continue;
    ++bounded;
    double farthest = 0;
    for (const int32_t c : incident[id]) {
      farthest = std::max(farthest, distance(v.centre[c], samples.points[id]));
    }
    for (const int32_t c : incident[id]) {
      if (distance(v.centre[c], samples.points[id]) < farthest) continue;
      EXPECT_EQ(p.vector[id], v.centre[c] - samples.points[id]);
      break;
    }
  }
  EXPECT_EQ(bounded, 8);
}

// Rows of samples that mirror each other in three edges of a cube meet about its diagonals: their
// facets have vertices on one line, more than two of them, and no area.
TEST(Method, FacetsOnALineAreLeftOut) {
  const test::Mesh cube{{{-1, -1, -1},
                         {-1, 1, -1},
                         {-1, 1, 1},
                         {-1, -1, 1},
                         {1, -1, -1},
                         {1, 1, -1},
                         {1, 1, 1},
                         {1, -1, 1}},
                        {{3, 2, 1},
                         {3, 1, 0},
                         {4, 5, 6},
                         {4, 6, 7},
                         {4, 7, 3},
                         {4, 3, 0},
                         {1, 2, 6},
                         {1, 6, 5},
                         {1, 5, 4},
                         {1, 4, 0},
                         {3, 7, 6},
                         {3, 6, 2}}};
  SamplingOptions options;
  options.count = 1000;
  const auto samples = sample_surface(cube.vertices, cube.triangles, options, 2);
  const AnalysisInput input{
      .points = samples.points, .triangles = cube.triangles, .vertices = cube.vertices};
  const MedialMesh mesh = MedialAnalysis(input, {}, nullptr).extract({.side = Side::inner});
  EXPECT_GT(mesh.generators.size(), 500u);
  EXPECT_GT(mesh.zero_area, 0);
  for (size_t f = 0; f < mesh.generators.size(); ++f) {
    const auto at = [&](int32_t i) {
      return mesh.vertices[mesh.face_vertices[mesh.face_offsets[f] + i]];
    };
    const int32_t size = mesh.face_offsets[f + 1] - mesh.face_offsets[f];
    Vec3 area;
    double longest = 0;
    for (int32_t i = 1; i < size; ++i) {
      longest = std::max(longest, distance(at(i), at(0)));
      if (i > 1) area = area + cross(at(i - 1) - at(0), at(i) - at(0));
    }
    EXPECT_GT(length(area), 1e-9 * longest * longest);
  }
}

// ---- Inside and outside ----------------------------------------------------------------------

// A closed mesh of the eight faces of an octahedron, each cut `cuts` times, pushed to `radius`
// times the unit sphere.
test::Mesh star(int cuts, const std::function<double(size_t)>& radius) {
  test::Mesh mesh{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int i = 0; i < cuts; ++i) {
    std::map<Edge, int32_t> middles;
    std::vector<Triangle> quarters;
    const auto middle = [&](int32_t p, int32_t q) {
      const Edge edge{std::min(p, q), std::max(p, q)};
      if (!middles.count(edge)) {
        middles[edge] = static_cast<int32_t>(mesh.vertices.size());
        mesh.vertices.push_back(normalized(mesh.vertices[p] + mesh.vertices[q]));
      }
      return middles[edge];
    };
    for (const auto& [a, b, c] : mesh.triangles) {
      const int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t :
           {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, Triangle{ab, bc, ca}}) {
        quarters.push_back(t);
      }
    }
    mesh.triangles = std::move(quarters);
  }
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    mesh.vertices[v] = radius(v) * mesh.vertices[v];
  }
  return mesh;
}

// A star whose radii differ at random; of great roughness it is far too sparsely sampled, so that
// Voronoi vertices lie on the wrong side of triangles that are no Delaunay triangles.
test::Mesh rough_star(int cuts, double roughness, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(1 - roughness, 1);
  return star(cuts, [&](size_t) { return 0.9 * uniform(random); });
}

test::Mesh rough_torus(int major, int minor, double roughness, uint32_t seed) {
  test::Mesh mesh = test::torus(major, minor);
  const auto noise = test::random_points(static_cast<int>(mesh.vertices.size()), seed);
  for (size_t v = 0; v < noise.size(); ++v) {
    mesh.vertices[v] = 0.6 * (mesh.vertices[v] + roughness * noise[v]);
  }
  return mesh;
}

// inner: every Voronoi vertex of the facet is inside, and it is bounded; outer: none is.
Side expected_side(const Oracle& oracle, const Edge& pq, const std::vector<uint8_t>& inside) {
  bool all = oracle.is_bounded(pq), any = false;
  for (const int32_t cell : oracle.ring(pq)) {
    all = all && inside[cell];
    any = any || inside[cell];
  }
  return all ? Side::inner : any ? Side::crossing : Side::outer;
}

void expect_same_sides(const MedialAnalysis& analysis, const Oracle& oracle,
                       const std::vector<uint8_t>& inside) {
  const auto edges = analysis.edge_rows();
  const auto sides = analysis.edge_sides();
  ASSERT_EQ(std::set<Edge>(edges.begin(), edges.end()), oracle.edges());
  std::map<Side, int> found;
  std::map<Edge, Side> side_of;
  for (size_t e = 0; e < edges.size(); ++e) {
    side_of[edges[e]] = expected_side(oracle, edges[e], inside);
    EXPECT_EQ(sides[e], side_of[edges[e]]) << edges[e][0] << " " << edges[e][1];
    ++found[sides[e]];
  }
  EXPECT_GT(found.size(), 1u);
  const MedialMesh both = analysis.extract({.thresholds = kAll});
  for (const Side side : {Side::inner, Side::outer}) {
    const MedialMesh mesh = analysis.extract({.thresholds = kAll, .side = side});
    for (const Side s : mesh.side) EXPECT_EQ(s, side);
    std::vector<Edge> expected;
    for (const Edge& pq : both.generators) {
      if (side_of[pq] == side) expected.push_back(pq);
    }
    EXPECT_EQ(std::vector<Edge>(mesh.generators.begin(), mesh.generators.end()), expected);
    for (const int32_t e : analysis.select({.thresholds = kAll, .side = side})) {
      EXPECT_EQ(side_of[edges[e]], side);
    }
  }
}

// Per cell: the winding number of the triangles at its Voronoi vertex exceeds 1/2.
std::vector<uint8_t> inside_surface(const Oracle& oracle, const test::Mesh& mesh) {
  std::vector<uint8_t> inside(oracle.cell_count());
  for (size_t c = 0; c < inside.size(); ++c) {
    inside[c] =
        test::turns(mesh.vertices, mesh.triangles, oracle.centre(static_cast<int32_t>(c))) > 0.5L;
  }
  return inside;
}

Oracle oracle_of(const Cloud& cloud) {
  return {cloud.points, cloud.step, library_cells(cloud.rows())};
}

void expect_same_sides_of_surface(test::Mesh mesh) {
  const Cloud cloud = rounded(mesh.vertices);
  ASSERT_EQ(cloud.points.size(), mesh.vertices.size());
  mesh.vertices = cloud.rows();
  const MedialAnalysis analysis({mesh.vertices, mesh.triangles}, {.threads = 2}, nullptr);
  ASSERT_EQ(analysis.sides_from(), SidesFrom::surface);
  const Oracle oracle = oracle_of(cloud);
  expect_same_sides(analysis, oracle, inside_surface(oracle, mesh));
}

// These have so many cells that the winding number of one is derived from that of a neighbour.
TEST(MethodSides, ByALargerClosedSurface) {
  expect_same_sides_of_surface(rough_star(4, 0.03, 1));
  expect_same_sides_of_surface(rough_star(3, 0.7, 2));
  expect_same_sides_of_surface(rough_torus(36, 14, 0.15, 3));
}

TEST(MethodSides, BySurfaceWithVerticesOfItsOwn) {
  for (uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto mesh = rough_star(1, 0.4, seed);
    const Cloud cloud = rounded(gaussian(60, seed));
    const auto rows = cloud.rows();
    const AnalysisInput input{
        .points = rows, .triangles = mesh.triangles, .vertices = mesh.vertices};
    const MedialAnalysis analysis(input, {.threads = 1}, nullptr);
    const Oracle oracle = oracle_of(cloud);
    expect_same_sides(analysis, oracle, inside_surface(oracle, mesh));
  }
}

// The corners of a cell vote, as user_guide and stage_inside.md have it; beyond the box all is
// outside because the normals look outwards.
TEST(MethodSides, ByNormals) {
  for (uint32_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double outward = seed % 2 ? 1 : -1;
    const Cloud cloud = rounded(test::ellipsoid(50, seed));
    const auto rows = cloud.rows();
    std::vector<Vec3> normals;
    for (const Vec3& p : rows) {
      normals.push_back(outward * 3 * Vec3{p.x, p.y / 0.5625, p.z / 0.16});
    }
    normals[7] = {};
    const AnalysisInput input{.points = rows, .normals = normals};
    const MedialAnalysis analysis(input, {.threads = 1}, nullptr);
    ASSERT_EQ(analysis.sides_from(), SidesFrom::normals);
    const auto cells = library_cells(rows);
    const Oracle oracle(cloud.points, cloud.step, cells);
    const Box box = box_of(rows);
    std::vector<uint8_t> inside;
    int32_t c = 0;
    for (const Ids& cell : cells) {
      const Real at = oracle.centre(c++);
      const Vec3 x{static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
      Box with = box;
      with.add(x);
      double vote = 0;
      for (const int32_t p : cell) {
        const Vec3 way = x - rows[p];
        if (normals[p] != Vec3{}) vote += dot(normals[p], way) / length(normals[p]) / length(way);
      }
      const bool within = with.low == box.low && with.high == box.high;
      inside.push_back(within ? vote < 0 : outward < 0);
    }
    expect_same_sides(analysis, oracle, inside);
    if (HasFailure()) return;
  }
}

// AUTOMATIC takes the sides from a closed surface, else from normals, else from Tight Cocone.
TEST(MethodSides, AreFromTheBestThatThereIs) {
  auto mesh = rough_star(2, 0.02, 1);
  const std::vector<Vec3> normals = mesh.vertices;
  const auto from = [&](const AnalysisInput& input) {
    return MedialAnalysis(input, {.threads = 1}, nullptr).sides_from();
  };
  EXPECT_EQ(from({.points = mesh.vertices, .triangles = mesh.triangles, .normals = normals}),
            SidesFrom::surface);
  mesh.triangles.pop_back();
  EXPECT_EQ(from({.points = mesh.vertices, .triangles = mesh.triangles, .normals = normals}),
            SidesFrom::normals);
  EXPECT_EQ(from({.points = mesh.vertices, .triangles = mesh.triangles}), SidesFrom::tight_cocone);
  EXPECT_EQ(from({.points = mesh.vertices}), SidesFrom::tight_cocone);
  EXPECT_THROW(MedialAnalysis({mesh.vertices}, {.sides = SidesFrom::surface}, nullptr),
               InvalidInputError);
  EXPECT_THROW(MedialAnalysis({mesh.vertices}, {.sides = SidesFrom::normals}, nullptr),
               InvalidInputError);
}

// If two stars overlap, the part of each inside the other bounds nothing; neither does a flake
// without thickness.
TEST(MethodSides, WhatLiesInsideOfTheUnionIsBuried) {
  test::Mesh mesh = rough_star(2, 0.3, 11);
  const auto other = rough_star(2, 0.3, 12);
  const auto first = static_cast<int32_t>(mesh.vertices.size());
  for (const Vec3& v : other.vertices) mesh.vertices.push_back(v + Vec3{0.7, 0.2, 0.1});
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
  std::vector<Vec3> points, normals;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    points.push_back((1.0 / 3) * (p + q + r));
    normals.push_back(normalized(cross(q - p, r - p)));
  }
  normals[5] = {};
  const double offset = 1e-3;
  const auto found = buried(points, normals, offset, mesh.vertices, mesh.triangles, {2, nullptr});
  int count = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto is_inside = [&](double height) {
      const Vec3 x = points[i] + height * normals[i];
      return test::turns(mesh.vertices, mesh.triangles, {x.x, x.y, x.z}) > 0.5L;
    };
    const bool expected = i != 5 && is_inside(offset) == is_inside(-offset);
    EXPECT_EQ(found[i] != 0, expected) << i;
    count += expected;
  }
  EXPECT_GT(count, 20);
  EXPECT_LT(count, static_cast<int>(points.size()) / 2);
}

// A Voronoi vertex is inside where it and its cell lie in the solid that Tight Cocone found: by
// brute force where the winding number of the watertight triangles is above 1/2, at the vertex and
// in the middle of the cell.
TEST(MethodSides, ByTightCocone) {
  for (uint32_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Cloud cloud =
        rounded(seed % 2 ? test::ellipsoid(400, seed) : rough_torus(30, 14, 0.02, seed).vertices);
    const auto rows = cloud.rows();
    const MedialAnalysis analysis({rows}, {.threads = 1}, nullptr);
    ASSERT_EQ(analysis.sides_from(), SidesFrom::tight_cocone);
    const test::Mesh solid{rows, analysis.tight_cocone()->triangles};
    ASSERT_GT(solid.triangles.size(), 400u);
    const auto cells = library_cells(rows);
    const Oracle oracle(cloud.points, cloud.step, cells);
    auto inside = inside_surface(oracle, solid);
    size_t c = 0;
    for (const Ids& cell : cells) {
      Vec3 middle;
      for (const int32_t p : cell) middle = middle + 0.25 * rows[p];
      if (test::turns(rows, solid.triangles, {middle.x, middle.y, middle.z}) < 0.5L) inside[c] = 0;
      ++c;
    }
    expect_same_sides(analysis, oracle, inside);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace medial
