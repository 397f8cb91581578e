// Cocone by brute force, and what Tight Cocone makes of samples that are sparse, noisy or missing.
#include "cocone/cocone.h"

#include <gtest/gtest.h>
#include <medial/analysis.h>

#include <random>

#include "axis/poles.h"
#include "cocone/peeling.h"
#include "cocone/solid.h"
#include "cocone/watertight_surface.h"
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

// ---- The surface -----------------------------------------------------------------------------

double volume(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const auto& [i, j, k] : triangles) sum += dot(points[i], cross(points[j], points[k])) / 6;
  return sum;
}

WatertightSurface surface_of(std::span<const Vec3> rows) {
  return watertight_surface(rows, {}, {2, nullptr});
}

constexpr double kEllipsoid = 4.0 / 3 * std::numbers::pi * 0.75 * 0.4;

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

// Dense samples: all are good, all lie on the surface, and next to nothing is missing.
TEST(TightCocone, TakesEverySampleOfASmoothSurface) {
  for (uint32_t seed = 0; seed < 4; ++seed) {
    const auto rows = test::ellipsoid(1500, seed);
    const WatertightSurface surface = surface_of(rows);
    expect_watertight(surface);
    EXPECT_EQ(std::count(surface.flat.begin(), surface.flat.end(), 0), 0);
    EXPECT_EQ(std::count(surface.good.begin(), surface.good.end(), 0), 0);
    EXPECT_EQ(surface.triangles.size(), 2 * rows.size() - 4);
    EXPECT_EQ(surface.left_outside, 0);
    EXPECT_NEAR(volume(rows, surface.triangles) / kEllipsoid, 1, 0.012);
  }
}

}  // namespace
}  // namespace medial
