// SPDX-License-Identifier: GPL-3.0-or-later
// Spreads points over the surface of the solid: over every slab, cone and ball, except where
// another one covers them.
#include <climits>
#include <numbers>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "base/rows.h"
#include "base/sort_unique.h"
#include "base/text.h"
#include "reduce/checked_mesh.h"
#include "reduce/envelope.h"

namespace medial {
namespace {

constexpr double kMostPoints = INT_MAX / 8;  // as an analysis accepts; derived: 32-bit ids
constexpr double kCovered = 1e-6;  // of the spacing; deeper points are covered; derived: rounding

class Painter {
 public:
  Painter(const SphereMesh& mesh, const Envelope& envelope, double spacing)
      : mesh_(mesh), envelope_(envelope), spacing_(spacing) {}

  // Returns an upper bound of the number of points that are tried.
  double tried(std::span<const Edge> edges) const {
    double sum = 0;
    for (const double r : mesh_.radius) sum += on_ball(r);
    for (const auto& [a, b] : edges) {
      const double whole = distance(mesh_.vertices[a], mesh_.vertices[b]);
      const double round = 2 * std::numbers::pi * std::max(mesh_.radius[a], mesh_.radius[b]);
      sum += (whole / spacing_ + 2) * (round / spacing_ + 1);
    }
    for (const Triangle& t : mesh_.triangles) {
      const double along = longest_side(t) / spacing_ + 2;
      sum += along * (along + 1);
    }
    return sum;
  }

  void paint_ball(int32_t v, std::vector<Vec3>& out) const {
    const double r = mesh_.radius[v];
    const auto count = static_cast<int64_t>(on_ball(r));
    for (int64_t i = 0; i < count; ++i) {
      const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
      const double flat = r * std::sqrt(std::max(0.0, 1 - z * z));
      const auto [sine, cosine] =
          portable::sine_cosine(static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0)));
      keep(mesh_.vertices[v] + Vec3{flat * cosine, flat * sine, r * z}, out);
    }
  }

  void paint_cone(int32_t a, int32_t b, std::vector<Vec3>& out) const {
    const Vec3 along = mesh_.vertices[b] - mesh_.vertices[a];
    const double whole = length(along), rise = mesh_.radius[b] - mesh_.radius[a];
    if (!(std::abs(rise) < whole)) return;
    const Vec3 axis = (1 / whole) * along;
    const double k = rise / whole, flat = std::sqrt(1 - k * k);
    const auto [u, v] = across(axis);
    const int64_t rings = steps(whole);
    const int64_t round = steps(2 * std::numbers::pi * std::max(mesh_.radius[a], mesh_.radius[b]));
    for (int64_t i = 0; i <= rings; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(rings);
      const Vec3 centre = mesh_.vertices[a] + share * along;
      const double radius = mesh_.radius[a] + share * rise;
      for (int64_t j = 0; j < round; ++j) {
        const auto [sine, cosine] = portable::sine_cosine(
            2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(round));
        const Vec3 n = flat * (cosine * u + sine * v) - k * axis;
        keep(centre + radius * n, out);
      }
    }
  }

  void paint_slab(const Triangle& t, std::vector<Vec3>& out) const {
    const auto [a, b, c] = t;
    const auto& x = mesh_.vertices;
    const auto& r = mesh_.radius;
    const TangentNormals tangents = tangent_normals({x[a], r[a]}, {x[b], r[b]}, {x[c], r[c]});
    if (!tangents.exist) return;
    const int64_t n = steps(longest_side(t));
    for (int64_t i = 0; i <= n; ++i) {
      for (int64_t j = 0; i + j <= n; ++j) {
        const double u = static_cast<double>(i) / static_cast<double>(n),
                     v = static_cast<double>(j) / static_cast<double>(n), w = 1 - u - v;
        const Vec3 centre = w * x[a] + u * x[b] + v * x[c];
        const double radius = w * r[a] + u * r[b] + v * r[c];
        for (const Vec3& normal : tangents.normals) keep(centre + radius * normal, out);
      }
    }
  }

 private:
  double on_ball(double r) const {
    return std::ceil(4 * std::numbers::pi * r * r / (spacing_ * spacing_)) + 1;
  }
  double longest_side(const Triangle& t) const {
    const Vec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    return std::max({distance(a, b), distance(b, c), distance(c, a)});
  }
  int64_t steps(double whole) const {
    return std::max<int64_t>(1, static_cast<int64_t>(std::ceil(whole / spacing_)));
  }
  void keep(const Vec3& point, std::vector<Vec3>& out) const {
    if (envelope_.find(point).nearest.distance >= -kCovered * spacing_) out.push_back(point);
  }

  const SphereMesh& mesh_;
  const Envelope& envelope_;
  double spacing_;
};

}  // namespace

Column<Vec3> solid_surface(const SphereMesh& given, double spacing, int threads,
                           Progress* progress) {
  require_sphere_mesh(given);
  if (!(spacing > 0)) {
    throw InvalidInputError("Expected a spacing above 0, found " + text(spacing) +
                            "; a hundredth of the diagonal is a fair one.");
  }
  Column<Vec3> all;
  if (given.vertices.empty()) return all;
  const SphereMesh mesh = without_doubles(given);
  const Envelope envelope(mesh);
  const Painter painter(mesh, envelope, spacing);
  auto edges = sides_of(mesh.triangles);
  edges.insert(edges.end(), mesh.wires.begin(), mesh.wires.end());
  sort_unique(edges);
  if (const double tried = painter.tried(edges); !(tried < kMostPoints)) {
    throw InvalidInputError("Expected a spacing for fewer than " + text(kMostPoints) +
                            " points, found " + text(spacing) + ", which needs about " +
                            text(tried) + "; choose a larger one.");
  }
  const Run run{thread_count(threads), progress};
  parallel_append_to(
      all, static_cast<int64_t>(mesh.triangles.size()), run,
      [&](int64_t t, auto& out, int) { painter.paint_slab(mesh.triangles[t], out); }, 16);
  parallel_append_to(
      all, static_cast<int64_t>(edges.size()), run,
      [&](int64_t e, auto& out, int) { painter.paint_cone(edges[e][0], edges[e][1], out); }, 16);
  parallel_append_to(
      all, static_cast<int64_t>(mesh.vertices.size()), run,
      [&](int64_t v, auto& out, int) { painter.paint_ball(static_cast<int32_t>(v), out); }, 16);
  return all;
}

}  // namespace medial
