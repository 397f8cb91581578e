// SPDX-License-Identifier: GPL-3.0-or-later
// Reduces a sphere mesh: finds places on its surface, collapses edges, and fits the spheres to the
// places.
#include <map>

#include "base/parallel.h"
#include "base/rows.h"
#include "base/text.h"
#include "base/triangle.h"
#include "reduce/checked_mesh.h"
#include "reduce/collapse.h"
#include "reduce/envelope.h"
#include "reduce/fit.h"
#include "reduce/flat_faces.h"

namespace medial {
namespace {

// share of the extent; deeper places are not on the surface
constexpr double kShareCovered = 0x1p-10;  // chosen: axis, midsurface
constexpr size_t kFitted = 1 << 14, kFittedPerSphere = 16;

SphereMesh inward(const SphereMesh& mesh, const Frame& frame) {
  SphereMesh result = mesh;
  for (Vec3& vertex : result.vertices) vertex = frame.inward(vertex);
  for (double& radius : result.radius) radius = frame.inward(radius);
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

// Thins the places evenly to as many as the fit of some spheres needs. Every second place lies on
// the other side of a slab, so the step is odd.
std::vector<TangentPlace> thinned(const std::vector<TangentPlace>& places, size_t spheres) {
  const size_t step = places.size() / (kFitted + kFittedPerSphere * spheres) | 1;
  std::vector<TangentPlace> result;
  for (size_t i = 0; i < places.size(); i += step) result.push_back(places[i]);
  return result;
}

void require_wanted(const ReduceOptions& options) {
  if (options.vertices >= 1) return;
  throw InvalidInputError("Expected at least 1 wanted vertex, found " +
                          std::to_string(options.vertices) + "; 200 is a usual number.");
}

void require_labels(const SphereMesh& mesh, const SheetLabels& labels) {
  require_one_each(labels.part.size(), mesh.triangles.size(), "one part per triangle",
                   "triangles; pass all of them");
  for (const int32_t v : labels.nodes) {
    if (v >= 0 && static_cast<size_t>(v) < mesh.vertices.size()) continue;
    throw InvalidInputError("Expected nodes that are rows of " +
                            std::to_string(mesh.vertices.size()) + " vertices, found " +
                            std::to_string(v) + "; number them from 0.");
  }
}

// Collapses a mesh in its unit, and fits what is left to the places. Between locks there is no fit:
// it costs more than the collapse, and brings sheets no nearer to the solid.
std::optional<Collapsed> reduced(const SphereMesh& mesh, const SphereComplex& complex,
                                 int32_t wanted, SheetLocks* locks, const Run& run) {
  begin_stage(run.progress, "Surface of the balls", 0, 0.2);
  const auto places = uncovered(mesh, tangent_places(mesh, complex, run), run);
  begin_stage(run.progress, "Collapse of edges", 0.2, locks ? 1 : 0.6);
  auto found = collapse_edges(mesh, complex, places, wanted, run, locks);
  if (!found || locks) return found;
  begin_stage(run.progress, "Fit of the spheres", 0.6, 1);
  const auto before = found->mesh;
  fit_spheres(found->mesh, thinned(places, found->row.size()), run);
  for (size_t v = 0; v < before.vertices.size(); ++v) {
    const bool stays =
        found->mesh.vertices[v] == before.vertices[v] && found->mesh.radius[v] == before.radius[v];
    if (!stays) found->row[v] = -1;
  }
  return found;
}

// Returns the spheres in the frame of the given ones; those that have not moved are the given ones.
SphereMesh outward(SphereMesh mesh, std::span<const int32_t> row, const SphereMesh& given,
                   const Frame& frame) {
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    mesh.vertices[v] = row[v] >= 0 ? given.vertices[row[v]] : frame.outward(mesh.vertices[v]);
    mesh.radius[v] = row[v] >= 0 ? given.radius[row[v]] : frame.outward(mesh.radius[v]);
  }
  return mesh;
}

// Returns the parts of triangles of which each is one of the given ones.
std::vector<int32_t> parts_for(const SphereMesh& mesh, const SphereMesh& given,
                               std::span<const int32_t> part) {
  std::map<Triangle, int32_t> of;
  for (size_t t = 0; t < part.size(); ++t) of.try_emplace(ascending(given.triangles[t]), part[t]);
  std::vector<int32_t> result;
  for (const Triangle& t : mesh.triangles) result.push_back(of.at(ascending(t)));
  return result;
}

SheetMesh as_sheets(SphereMesh mesh, const std::vector<FlatFace>& faces,
                    const std::vector<int32_t>& row) {
  SheetMesh result;
  result.vertices = std::move(mesh.vertices);
  result.radius = std::move(mesh.radius);
  result.wires = std::move(mesh.wires);
  result.row.assign(row.begin(), row.end());
  result.face_offsets = {0};
  for (const FlatFace& face : faces) {
    result.face_vertices.insert(result.face_vertices.end(), face.corners.begin(),
                                face.corners.end());
    result.face_offsets.push_back(static_cast<int32_t>(result.face_vertices.size()));
    result.part.push_back(face.part);
  }
  return result;
}

}  // namespace

SphereMesh reduce(const SphereMesh& given, const ReduceOptions& options, Progress* progress) {
  require_sphere_mesh(given);
  require_wanted(options);
  SphereMesh mesh = without_doubles(given);
  if (mesh.vertices.size() <= static_cast<size_t>(options.vertices)) return mesh;
  const Run run{thread_count(options.threads), progress};
  const Frame frame = frame_of(mesh);
  const SphereMesh inner = inward(mesh, frame);
  auto found = reduced(inner, SphereComplex(inner), options.vertices, nullptr, run);
  advance(progress, 1);
  return outward(std::move(found->mesh), found->row, given, frame);
}

std::optional<SheetMesh> reduce_sheets(const SphereMesh& given, const SheetLabels& labels,
                                       const ReduceOptions& options, Progress* progress) {
  require_sphere_mesh(given);
  require_wanted(options);
  require_labels(given, labels);
  const SphereMesh mesh = without_doubles(given);
  const auto part = parts_for(mesh, given, labels.part);
  const Run run{thread_count(options.threads), progress};
  const Frame frame = frame_of(mesh);
  const SphereMesh inner = inward(mesh, frame);
  const SphereComplex complex(inner);
  SheetLocks locks(complex, {part, labels.nodes, frame.inward(labels.shortest)},
                   inner.vertices.size());
  auto found = reduced(inner, complex, options.vertices, &locks, run);
  if (!found) return {};
  auto faces = flat_faces(found->mesh, found->part);
  leave_out_straight_vertices(found->mesh, faces, found->row);
  advance(progress, 1);
  return as_sheets(outward(std::move(found->mesh), found->row, given, frame), faces, found->row);
}

}  // namespace medial
