// SPDX-License-Identifier: GPL-3.0-or-later
// Inner axes of 500 samples of shapes whose axes are known exactly: how far the vertices of the
// output lie from the axis, and the points of the axis from the output. Every bar is one and a half
// times what was measured.
#include <gtest/gtest.h>
#include <medial/analysis.h>
#include <medial/sampling.h>

#include <functional>
#include <random>

#include "base/rows.h"
#include "shapes.h"

namespace medial {
namespace {

struct Shape {
  const char* name;
  test::Mesh mesh;  // fine
  bool smooth;
  std::function<double(const Vec3&)> to_axis;  // distance of a place to the exact axis
  std::vector<Vec3> axis;                      // points spread over it
  // Bars, relative to the diagonal of the box.
  double mean, max, coverage;

  friend void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }
};

// A grid over [0, 1]^2 on a surface that closes in u; equal vertices are welded by their
// coordinates.
test::Mesh revolved(int around, int along, const std::function<Vec3(double, double)>& at) {
  test::Mesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j <= along; ++j) {
      mesh.vertices.push_back(at(2 * std::numbers::pi * i / around, 1.0 * j / along));
    }
  }
  const auto id = [&](int i, int j) { return (i % around) * (along + 1) + j; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < along; ++j) {
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

Vec3 on_unit_sphere(double u, double height) {
  const double v = std::numbers::pi * (height - 0.5);
  const double r = height == 0 || height == 1 ? 0 : std::cos(v);  // one pole, not many
  return {r * std::cos(u), r * std::sin(u), std::sin(v)};
}

// Semi-axes 1, 0.8 and 0.4: the axis is an elliptic disc in the plane z = 0, up to the centres of
// curvature: semi-axes (1 - 0.16) and (0.8 - 0.16 / 0.8).
Shape ellipsoid() {
  Shape s{"ellipsoid", {}, true, {}, {}, 0.00121, 0.00533, 0.0302};
  s.mesh = revolved(96, 48, [](double u, double h) {
    const Vec3 p = on_unit_sphere(u, h);
    return Vec3{p.x, 0.8 * p.y, 0.4 * p.z};
  });
  const double a = 0.84, b = 0.6;
  s.to_axis = [=](const Vec3& p) {
    const double level = std::hypot(p.x / a, p.y / b);
    // Beyond the rim the way along the ray to the middle is taken: no less than the true one.
    const double beyond = level <= 1 ? 0 : (1 - 1 / level) * std::hypot(p.x, p.y);
    return std::hypot(p.z, beyond);
  };
  for (double x = -a; x <= a; x += 0.02) {
    for (double y = -b; y <= b; y += 0.02) {
      if (std::hypot(x / a, y / b) <= 1) s.axis.push_back({x, y, 0});
    }
  }
  return s;
}

Shape torus() {
  Shape s{"torus", {}, true, {}, {}, 0.00218, 0.0413, 0.00059};
  s.mesh = revolved(96, 48, [](double u, double h) {
    const double v = h == 1 ? 0 : 2 * std::numbers::pi * h, r = 1 + 0.4 * std::cos(v);
    return Vec3{r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)};
  });
  s.to_axis = [](const Vec3& p) { return std::hypot(std::hypot(p.x, p.y) - 1, p.z); };
  for (int i = 0; i < 500; ++i) {
    const double u = 2 * std::numbers::pi * i / 500;
    s.axis.push_back({std::cos(u), std::sin(u), 0});
  }
  return s;
}

// A cylinder of radius 0.3 from z = -1 to 1 with halves of spheres: the axis is that segment.
Shape capsule() {
  Shape s{"capsule", {}, true, {}, {}, 0.00103, 0.0193, 0.000193};
  s.mesh = revolved(48, 49, [](double u, double h) {
    Vec3 p = on_unit_sphere(u, h);
    p = 0.3 * p;
    p.z += h > 0.5 ? 1 : -1;
    return p;
  });
  s.to_axis = [](const Vec3& p) { return length({p.x, p.y, std::max(0.0, std::abs(p.z) - 1)}); };
  for (int i = 0; i <= 200; ++i) s.axis.push_back({0, 0, -1 + 0.01 * i});
  return s;
}

Shape sphere() {
  Shape s{"sphere", {}, true, {}, {{0, 0, 0}}, 2.63e-6, 7.95e-6, 8.5e-8};
  s.mesh = revolved(96, 48, [](double u, double h) { return on_unit_sphere(u, h); });
  s.to_axis = [](const Vec3& p) { return length(p); };
  return s;
}

// 2 x 1.2 x 0.8: the axis is where the two nearest faces are equally near.
Shape box() {
  Shape s{"box", {}, false, {}, {}, 0.00131, 0.0144, 0.014};
  const Vec3 half{1, 0.6, 0.4};
  for (int i = 0; i < 8; ++i) {
    s.mesh.vertices.push_back(
        {i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
  }
  s.mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const auto depths = [half](const Vec3& p) {
    std::array<double, 6> d{half.x - p.x, half.x + p.x, half.y - p.y,
                            half.y + p.y, half.z - p.z, half.z + p.z};
    std::sort(d.begin(), d.end());
    return d;
  };
  // Half of the difference is a walk away from the nearest face; at most sqrt(2) times as far.
  s.to_axis = [=](const Vec3& p) { return (depths(p)[1] - depths(p)[0]) / 2; };
  for (double x = -1; x <= 1; x += 0.02) {
    for (double y = -0.6; y <= 0.6; y += 0.02) {
      for (double z = -0.4; z <= 0.4; z += 0.02) {
        const auto d = depths({x, y, z});
        if (d[0] > 0.1 && d[1] - d[0] < 1e-9) s.axis.push_back({x, y, z});
      }
    }
  }
  return s;
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto to_segment = [&](const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double share = std::clamp(dot(p - from, way) / squared_length(way), 0.0, 1.0);
    return distance(p, from + share * way);
  };
  double least = std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
  const Vec3 n = cross(b - a, c - a);
  const bool above = dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
                     dot(cross(a - c, p - c), n) >= 0;
  if (above && length(n) > 0) least = std::min(least, std::abs(dot(p - a, n)) / length(n));
  return least;
}

double distance_to_mesh(const Vec3& p, const MedialMesh& mesh) {
  double least = HUGE_VAL;
  const auto at = [&](int32_t corner) { return mesh.vertices[mesh.face_vertices[corner]]; };
  for (size_t f = 0; f + 1 < mesh.face_offsets.size(); ++f) {
    const int32_t begin = mesh.face_offsets[f];
    for (int32_t i = begin + 2; i < mesh.face_offsets[f + 1]; ++i) {
      least = std::min(least, distance_to_triangle(p, at(begin), at(i - 1), at(i)));
    }
  }
  return least;
}

class ExactShapes : public testing::TestWithParam<Shape> {};

TEST_P(ExactShapes, AreMetByFiveHundredSamples) {
  const Shape& shape = GetParam();
  SamplingOptions options;
  options.count = 500;
  options.smooth = shape.smooth;
  const auto samples = sample_surface(shape.mesh.vertices, shape.mesh.triangles, options, 2);
  EXPECT_NEAR(static_cast<double>(samples.points.size()), 500, 10);
  const AnalysisInput input{
      .points = samples.points, .triangles = shape.mesh.triangles, .vertices = shape.mesh.vertices};
  const MedialMesh axis =
      MedialAnalysis(input, {.threads = 2}, nullptr).extract({.side = Side::inner});
  ASSERT_GT(axis.vertices.size(), 10u);
  double sum = 0, max = 0, missed = 0;
  for (const Vec3& v : axis.vertices) {
    const double away = shape.to_axis(v);
    sum += away;
    max = std::max(max, away);
  }
  for (const Vec3& p : shape.axis) missed = std::max(missed, distance_to_mesh(p, axis));
  const double diagonal = length(box_of(samples.points).extent());
  const double mean = sum / static_cast<double>(axis.vertices.size());
  EXPECT_LT(mean / diagonal, shape.mean);
  EXPECT_LT(max / diagonal, shape.max);
  EXPECT_LT(missed / diagonal, shape.coverage);
}

INSTANTIATE_TEST_SUITE_P(All, ExactShapes,
                         testing::Values(sphere(), ellipsoid(), torus(), capsule(), box()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace medial
