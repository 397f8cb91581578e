// SPDX-License-Identifier: GPL-3.0-or-later
// Seeded inputs for the native tests, and what they ask of triangles.
#pragma once

#include <array>
#include <map>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "inside/boundary.h"

namespace medial::test {

inline std::vector<Vec3> random_points(int count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {uniform(random), uniform(random), uniform(random)};
  return points;
}

inline std::vector<Vec3> ellipsoid(int count, uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    p = normalized({normal(random), normal(random), normal(random)});
    p = {p.x, 0.75 * p.y, 0.4 * p.z};
  }
  return points;
}

// 0 in the middle of that ellipsoid, 1 on it.
inline double height_in_ellipsoid(const Vec3& x) { return length({x.x, x.y / 0.75, x.z / 0.4}); }

struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

// A box with outward faces between two of its corners.
inline Mesh box(const Vec3& low, const Vec3& high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// Two squares of side 2 that meet at a right angle in the edge from 0 to 1, along y.
inline Mesh folded() {
  return {{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {2, 2, 0}, {0, 0, 2}, {0, 2, 2}},
          {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}}};
}

inline Mesh joined(Mesh a, const Mesh& b) {
  const auto first = static_cast<int32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) {
    a.triangles.push_back({first + i, first + j, first + k});
  }
  return a;
}

inline Mesh turned(Mesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

// A torus of radii 1 and 0.4, slightly turned out of the axes.
inline Mesh torus(int major, int minor) {
  Mesh mesh;
  const double turn = 2 * std::numbers::pi;
  for (int i = 0; i < major; ++i) {
    for (int j = 0; j < minor; ++j) {
      const double u = turn * (i + 0.5 * (j % 2)) / major, v = turn * j / minor,
                   r = 1 + 0.4 * std::cos(v);
      const Vec3 p{r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)};
      mesh.vertices.push_back({p.x + 0.1 * p.z, p.y - 0.05 * p.x, p.z + 0.03 * p.y});
      const int a = i * minor + j, b = (i + 1) % major * minor + j;
      const int c = i * minor + (j + 1) % minor, d = (i + 1) % major * minor + (j + 1) % minor;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

// How many triangles use each edge.
inline std::map<Edge, int> edge_uses(std::span<const Triangle> triangles) {
  std::map<Edge, int> uses;
  for (const Triangle& t : triangles) {
    for (const int32_t corner : t) {
      const auto [p, q] = link_of(t, corner);
      ++uses[{std::min(p, q), std::max(p, q)}];
    }
  }
  return uses;
}

}  // namespace medial::test
