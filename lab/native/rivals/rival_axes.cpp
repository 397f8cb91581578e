// SPDX-License-Identifier: GPL-3.0-or-later
#include "rivals/rival_axes.h"

#include <map>

#include "analysis_parts.h"
#include "axis/medial_mesh.h"
#include "axis/umbrellas.h"
#include "rivals/loose_edges.h"
#include "rivals/pole_balls.h"

namespace medial {
namespace {

using Parts = MedialAnalysis::Parts;

MedialMesh facets_in(const Parts& made, const Selection& selection, const Run& run) {
  if (selection.wanted().side != Side::both) require_solid(made);
  return voronoi_facets(selection, made.samples, made.triangulation, made.voronoi, made.edges, run);
}

// Adds edges between Voronoi vertices, which are lowest cells. No two vertices of a mesh coincide.
void add_edges(MedialMesh& mesh, std::span<const Edge> edges, const Parts& made) {
  const auto place = [](const Vec3& v) { return std::array{v.x, v.y, v.z}; };
  std::map<std::array<double, 3>, int32_t> vertices;
  for (const Vec3& v : mesh.vertices) {
    vertices.emplace(place(v), static_cast<int32_t>(vertices.size()));
  }
  const auto vertex_of = [&](int32_t cell) {
    const Vec3& centre = made.voronoi.centre[cell];
    const auto next = static_cast<int32_t>(vertices.size());
    const auto [found, is_new] = vertices.emplace(place(centre), next);
    if (is_new) {
      const Vec3& sample = made.samples.points[made.triangulation.cells[cell][0]];
      mesh.vertices.push_back(centre);
      mesh.radius.push_back(distance(centre, sample));
    }
    return found->second;
  };
  for (const auto& [a, b] : edges) {
    const int32_t first = vertex_of(a), second = vertex_of(b);
    mesh.edges.push_back({first, second});
  }
}

}  // namespace

MedialMesh axis_by_remark(const MedialAnalysis& analysis, Against against,
                          const Extraction& extraction, Progress* progress) {
  const Parts& made = analysis.parts();
  const std::vector<Vec3>& points = made.samples.points;
  const Run run = made.run();
  const auto incident = incident_cells(made.triangulation, made.samples.count(), run);
  const Umbrellas around = umbrellas(points, made.triangulation, made.voronoi, incident, run);
  const Poles vectors = poles(points, made.triangulation, made.voronoi, incident, run);
  const Significance significance =
      significance_by_remark(points, made.edges, around, vectors, against, run);
  const Facets facets{points,     made.triangulation, made.voronoi,
                      made.edges, significance,       made.sides};
  MedialMesh mesh = facets_in(made, Selection(extraction, facets), made.run(progress));
  bring_outward(mesh, made.frame);
  return mesh;
}

MedialMesh axis_by_size(const MedialAnalysis& analysis, const SizeExtraction& extraction,
                        Progress* progress) {
  const Parts& made = analysis.parts();
  const SizeSelection selection(extraction, facets_of(made));
  MedialMesh mesh = facets_in(made, selection, made.run(progress));
  if (extraction.condition == SizeCondition::lambda) {
    add_edges(mesh, loose_edges(selection, mesh.generators, made.samples.row, made.run()), made);
  }
  bring_outward(mesh, made.frame);
  return mesh;
}

std::vector<int32_t> select_by_size(const MedialAnalysis& analysis,
                                    const SizeExtraction& extraction) {
  const Parts& made = analysis.parts();
  const SizeSelection selection(extraction, facets_of(made));
  if (extraction.side != Side::both) require_solid(made);
  return selected(selection, edges_by_row(made), made.run());
}

MedialMesh pole_axis(const MedialAnalysis& analysis, Side side, Progress* progress) {
  const Parts& made = analysis.parts();
  const Selection checked({.side = side}, facets_of(made));  // throws for a side that is none
  if (side != Side::both) require_solid(made);
  const Run run = made.run();
  const auto incident = incident_cells(made.triangulation, made.samples.count(), run);
  throw_if_cancelled(progress);
  MedialMesh mesh =
      pole_balls(made.samples, made.triangulation, made.voronoi, incident, made.sides, side, run);
  bring_outward(mesh, made.frame);
  return mesh;
}

}  // namespace medial
