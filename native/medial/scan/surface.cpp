// SPDX-License-Identifier: GPL-3.0-or-later
// The noise of the vertices of faces, and vertices that are moved onto smooth surfaces.
#include <medial/scan.h>

#include "base/parallel.h"
#include "base/rows.h"
#include "base/text.h"
#include "scan/local_quadric.h"
#include "scan/noise.h"

namespace medial {
namespace {

constexpr size_t kFewest = 24;  // neighbours on which a vertex is moved
constexpr double kFar = 5;      // units of the noise: a vertex farther off stays; chosen: unseen

// The distinct vertices that have a normal, in spatial order. Normals in one place are added.
struct Vertices {
  std::vector<Vec3> places, normals;
  std::vector<int32_t> of_row;  // the vertex of each row; -1 for one without a normal
};

Vertices vertices_of(std::span<const Vec3> points, std::span<const Vec3> normals, const Run& run) {
  require_one_each(normals.size(), points.size(), "one normal per point",
                   "points; pass all of them");
  require_finite(normals, "normal");
  const DistinctRows distinct = distinct_rows(points, "points", run);
  std::vector<Vec3> sums(static_cast<size_t>(distinct.count()));
  for (size_t row = 0; row < points.size(); ++row) {
    Vec3& sum = sums[distinct.point_of_row[row]];
    sum = sum + normals[row];
  }
  Vertices found;
  std::vector<int32_t> number(static_cast<size_t>(distinct.count()), -1);
  for (int32_t i = 0; i < distinct.count(); ++i) {
    const double size = length(sums[i]);
    if (!(size > 0)) continue;
    number[i] = static_cast<int32_t>(found.places.size());
    found.places.push_back(distinct.points[i]);
    found.normals.push_back((1 / size) * sums[i]);
  }
  for (const int32_t i : distinct.point_of_row) found.of_row.push_back(number[i]);
  return found;
}

// Returns the place on the quadric of the neighbours; the vertex itself where there is none.
Vec3 smoothed(const PointTree& tree, std::span<const Vec3> normals, int32_t id,
              const SurfaceNoise& measure, std::vector<Vec3>& near) {
  const Vec3& centre = tree[id];
  const double squared = measure.radius * measure.radius;
  Vec3 normal;
  near.clear();
  tree.visit([&](const Box& box) { return squared_distance(box, centre) <= squared; },
             [&](const Vec3& p) {
               const Vec3& other = normals[&p - &tree[0]];
               if (squared_length(p - centre) > squared) return;
               if (!(dot(other, normals[id]) > kSameWay)) return;
               near.push_back(p);
               normal = normal + other;
             });
  if (near.size() < kFewest) return centre;
  const auto first = fit_quadric(near, centre, normalized(normal), measure.radius, Weights::smooth);
  if (!first) return centre;
  const auto found = fit_quadric(near, centre, first->tilted(), measure.radius, Weights::smooth);
  if (!found || std::abs(found->terms[0]) * found->radius > kFar * measure.noise) return centre;
  return found->place();
}

}  // namespace

SurfaceNoise surface_noise(std::span<const Vec3> points, std::span<const Vec3> normals, int threads,
                           Progress* progress) {
  const Run run{thread_count(threads), progress};
  const Vertices vertices = vertices_of(points, normals, run);
  if (vertices.places.size() < 4) return {};
  const double diagonal = length(box_of(vertices.places).extent());
  const NoiseFigures figures =
      noise_of(PointTree(vertices.places), diagonal, run, vertices.normals);
  return {figures.spacing, figures.noise, figures.radius};
}

std::vector<Vec3> smooth_vertices(std::span<const Vec3> points, std::span<const Vec3> normals,
                                  const SurfaceNoise& measure, int threads, Progress* progress) {
  const Run run{thread_count(threads), progress};
  const Vertices vertices = vertices_of(points, normals, run);
  std::vector<Vec3> moved(points.begin(), points.end());
  if (!(measure.noise > 0)) return moved;
  const PointTree tree(vertices.places);
  std::vector<Vec3> places(vertices.places.size());
  parallel_chunks(
      tree.size(), run,
      [&](int64_t begin, int64_t end, int) {
        std::vector<Vec3> near;
        for (int64_t i = begin; i < end; ++i) {
          places[i] = smoothed(tree, vertices.normals, static_cast<int32_t>(i), measure, near);
        }
      },
      128);
  for (size_t row = 0; row < moved.size(); ++row) {
    if (vertices.of_row[row] >= 0) moved[row] = places[vertices.of_row[row]];
  }
  return moved;
}

}  // namespace medial
