// SPDX-License-Identifier: GPL-3.0-or-later
#include "cocone/watertight_surface.h"

#include "base/rows.h"
#include "base/sort.h"

namespace medial {
std::vector<Triangle> in_rows(std::vector<Triangle> triangles, const Samples& samples,
                              const Run& run) {
  parallel_for(static_cast<int64_t>(triangles.size()), run, [&](int64_t i) {
    Triangle& t = triangles[i];
    for (int32_t& id : t) id = samples.row[id];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  });
  const auto order =
      lexicographic_order(std::span<const Triangle>(triangles), samples.point_of_row.size(), run);
  reorder(triangles, order, run);
  return triangles;
}

WatertightSurface describe(TightCocone found, SolidBoundary boundary, const Samples& samples,
                           const Run& run) {
  const std::vector<int32_t> order = samples_by_row(samples);
  WatertightSurface result;
  result.triangles = in_rows(std::move(boundary.triangles), samples, run);
  result.samples = rows_of(samples.row, order);
  result.flat = rows_of(found.flat, order);
  result.good = rows_of(found.good, order);
  result.on_surface = rows_of(boundary.on_surface, order);
  result.nonmanifold_edges = boundary.nonmanifold_edges;
  result.nonmanifold_vertices = boundary.nonmanifold_vertices;
  result.inner_cells = boundary.inner_cells;
  result.left_outside = boundary.left_outside;
  result.cavities = found.cavities;
  result.duplicates = static_cast<int64_t>(samples.point_of_row.size() - samples.row.size());
  result.sides = std::move(found.sides);
  return result;
}

WatertightSurface watertight_surface(std::span<const Vec3> points, const CoconeOptions& options,
                                     int threads, Progress* progress) {
  const Run run{thread_count(threads), progress};
  Timings timings;
  Stopwatch watch(timings);
  begin_stage(run.progress, "Samples", 0, 0.02);
  const Samples samples = make_samples(points, {run.threads, nullptr});
  require_volume(samples.points);
  watch.lap("samples");
  const Triangulation t = triangulate(samples.points, run);
  watch.lap("triangulation");
  const Voronoi v = voronoi(samples.points, t, run);
  watch.lap("voronoi");
  const Csr<int32_t> incident = incident_cells(t, samples.count(), run);
  const Poles p = poles(samples.points, t, v, incident, run);
  watch.lap("poles");
  TightCocone found = tight_cocone(samples.points, t, v, incident, p, options, run);
  watch.lap("tight cocone");
  begin_stage(run.progress, "Surface", 0.99, 1);
  SolidBoundary boundary = solid_boundary(t, incident, found.sides, run);
  WatertightSurface result = describe(std::move(found), std::move(boundary), samples, run);
  watch.lap("surface");
  result.timings = std::move(timings);
  advance(run.progress, 1);
  return result;
}

}  // namespace medial
