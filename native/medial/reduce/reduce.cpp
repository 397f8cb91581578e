// SPDX-License-Identifier: GPL-3.0-or-later
// Reduces a sphere mesh: finds places on its surface, collapses edges, and fits the spheres to the
// places.
#include "base/parallel.h"
#include "base/rows.h"
#include "reduce/checked_mesh.h"
#include "reduce/collapse.h"
#include "reduce/envelope.h"
#include "reduce/fit.h"

namespace medial {
namespace {

// share of the extent; deeper places are not on the surface
constexpr double kShareCovered = 0x1p-10;
constexpr size_t kFitted = 1 << 16, kFittedPerSphere = 128;

SphereMesh inward(const SphereMesh& mesh, const Unit& unit) {
  SphereMesh result = mesh;
  for (Vec3& vertex : result.vertices) vertex = unit.inward(vertex);
  for (double& radius : result.radius) radius = unit.inward(radius);
  return result;
}

std::vector<TangentPlace> uncovered(const SphereMesh& mesh, const std::vector<TangentPlace>& places,
                                    const Run& run) {
  const Envelope envelope(mesh);
  return parallel_append<TangentPlace>(
      static_cast<int64_t>(places.size()), run,
      [&](int64_t i, auto& out, int) {
        if (!envelope.covers(places[i].point, kShareCovered)) out.push_back(places[i]);
      },
      256);
}

// Thins the places evenly to as many as the fit of some spheres needs.
std::vector<TangentPlace> thinned(const std::vector<TangentPlace>& places, size_t spheres) {
  const size_t step = std::max<size_t>(1, places.size() / (kFitted + kFittedPerSphere * spheres));
  std::vector<TangentPlace> result;
  for (size_t i = 0; i < places.size(); i += step) result.push_back(places[i]);
  return result;
}

}  // namespace

SphereMesh reduce(const SphereMesh& given, const ReduceOptions& options, Progress* progress) {
  require_sphere_mesh(given);
  if (options.vertices < 1) {
    throw InvalidInputError("Expected at least 1 wanted vertex, found " +
                            std::to_string(options.vertices) + "; 200 is a usual number.");
  }
  SphereMesh mesh = without_doubles(given);
  if (mesh.vertices.size() <= static_cast<size_t>(options.vertices)) return mesh;
  const Run run{thread_count(options.threads), progress};
  const Unit unit = unit_of(mesh);
  mesh = inward(mesh, unit);
  const SphereComplex complex(mesh);
  begin_stage(progress, "Surface of the balls", 0, 0.2);
  const auto places = uncovered(mesh, tangent_places(mesh, complex, run), run);
  begin_stage(progress, "Collapse of edges", 0.2, 0.6);
  Collapsed collapsed = collapse_edges(mesh, complex, places, options.vertices, run);
  begin_stage(progress, "Fit of the spheres", 0.6, 1);
  const auto some = thinned(places, collapsed.row.size());
  const bool moved = fit_spheres(collapsed.mesh, some, run);
  SphereMesh result = std::move(collapsed.mesh);
  for (size_t v = 0; v < result.vertices.size(); ++v) {
    const int32_t row = moved ? -1 : collapsed.row[v];
    result.vertices[v] = row >= 0 ? given.vertices[row] : unit.outward(result.vertices[v]);
    result.radius[v] = row >= 0 ? given.radius[row] : unit.outward(result.radius[v]);
  }
  advance(progress, 1);
  return result;
}

}  // namespace medial
