// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/tangent_places.h"

#include <numbers>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "reduce/cone_and_slab.h"

namespace medial {
namespace {

constexpr int kRound = 12;       // directions all around a wire
constexpr int kDirections = 64;  // directions of a ball

// Returns directions spread evenly over the sphere, on a spiral by the golden angle.
std::array<Vec3, kDirections> directions() {
  std::array<Vec3, kDirections> result;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * i + 1.0) / kDirections, r = std::sqrt(1 - z * z);
    const auto [sine, cosine] = portable::sine_cosine(i * std::numbers::pi * (3 - std::sqrt(5.0)));
    result[i] = {r * cosine, r * sine, z};
  }
  return result;
}

class Places {
 public:
  Places(const SphereMesh& mesh, const SphereComplex& complex) : mesh_(mesh), complex_(complex) {}

  void add_slab(const Triangle& t, std::vector<TangentPlace>& out) const {
    const auto [a, b, c] = t;
    const TangentNormals tangents = tangent_normals(sphere(a), sphere(b), sphere(c));
    if (!tangents.exist) return;
    const Vec3 centre = (1.0 / 3) * (at(a) + at(b) + at(c));
    const double radius = (mesh_.radius[a] + mesh_.radius[b] + mesh_.radius[c]) / 3;
    const double area = length(cross(at(b) - at(a), at(c) - at(a))) / 2;
    for (const Vec3& n : tangents.normals) out.push_back({centre + radius * n, n, area, t});
  }

  // Adds places around a wire, or around a rim from one side of its slab to the other.
  void add_cone(int32_t a, int32_t b, std::vector<TangentPlace>& out) const {
    const Vec3 along = at(b) - at(a);
    const double whole = length(along), rise = mesh_.radius[b] - mesh_.radius[a];
    if (!(std::abs(rise) < whole)) return;
    const Vec3 axis = (1 / whole) * along;
    const double k = rise / whole, flat = std::sqrt(1 - k * k);
    const auto [outward, half] = sector(a, b, axis, flat);
    const Vec3 across = cross(axis, outward);
    const int steps = std::max(1, static_cast<int>(std::ceil(kRound * half / std::numbers::pi)));
    const double radius = (mesh_.radius[a] + mesh_.radius[b]) / 2;
    const double area = 2 * half / steps * radius * whole;
    for (int i = 0; i < steps; ++i) {
      const auto turn = portable::sine_cosine(half * ((2 * i + 1.0) / steps - 1));
      const Vec3 round = turn.cosine * outward + turn.sine * across;
      const Vec3 n = flat * round - k * axis;
      out.push_back({0.5 * (at(a) + at(b)) + radius * n, n, area, {a, b, -1}});
    }
  }

  void add_ball(int32_t v, std::vector<TangentPlace>& out) const {
    static const auto spread = directions();
    const double r = mesh_.radius[v];
    if (!(r > 0)) return;
    for (const Vec3& n : spread) {
      const bool sticks_out = std::all_of(
          complex_.neighbours(v).begin(), complex_.neighbours(v).end(),
          [&](int32_t other) { return dot(n, at(other) - at(v)) < r - mesh_.radius[other]; });
      if (!sticks_out) continue;
      const double area = 4 * std::numbers::pi * r * r / kDirections;
      out.push_back({at(v) + r * n, n, area, {v, -1, -1}});
    }
  }

 private:
  const Vec3& at(int32_t v) const { return mesh_.vertices[v]; }
  Sphere sphere(int32_t v) const { return {at(v), mesh_.radius[v]}; }

  // Returns a direction across an edge, and the angle to both sides of it within which the cone is
  // visible, or 0 where the slab is a line, which tells no direction. There must be at most one
  // slab at the edge.
  std::pair<Vec3, double> sector(int32_t a, int32_t b, const Vec3& axis, double flat) const {
    int32_t third = -1;
    for (const int32_t t : complex_.triangles_of(a)) {
      for (const int32_t corner : complex_.triangle(t)) {
        const auto& [i, j, k] = complex_.triangle(t);
        if (i != b && j != b && k != b) continue;
        if (corner != a && corner != b) third = corner;
      }
    }
    if (third < 0) return {across(axis).front(), std::numbers::pi};
    const Vec3 way = at(third) - at(a), inward = way - dot(way, axis) * axis;
    if (!(squared_length(inward) > kNoDistance * kNoDistance)) return {};
    const Vec3 outward = -normalized(inward);
    const TangentNormals tangents = tangent_normals(sphere(a), sphere(b), sphere(third));
    if (!tangents.exist) return {outward, std::numbers::pi / 2};
    const double cosine = std::clamp(dot(tangents.normals[0], outward) / flat, -1.0, 1.0);
    return {outward, portable::acos(cosine)};
  }

  const SphereMesh& mesh_;
  const SphereComplex& complex_;
};

}  // namespace

std::vector<TangentPlace> tangent_places(const SphereMesh& mesh, const SphereComplex& complex,
                                         const Run& run) {
  const Places places(mesh, complex);
  std::vector<TangentPlace> all;
  parallel_append_to(all, static_cast<int64_t>(mesh.triangles.size()), run,
                     [&](int64_t t, auto& out, int) { places.add_slab(mesh.triangles[t], out); });
  parallel_append_to(all, static_cast<int64_t>(mesh.vertices.size()), run,
                     [&](int64_t id, auto& out, int) {
                       const auto v = static_cast<int32_t>(id);
                       for (const int32_t other : complex.neighbours(v)) {
                         if (v < other && complex.triangle_count(v, other) < 2) {
                           places.add_cone(v, other, out);
                         }
                       }
                       places.add_ball(v, out);
                     });
  return all;
}

}  // namespace medial
