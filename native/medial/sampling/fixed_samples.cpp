// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/fixed_samples.h"

namespace medial {
namespace {

// Returns the mean normal of the triangles at an edge.
Vec3 edge_normal(const CurvedSurface& surface, const Edge& ends, double share) {
  Vec3 sum;
  for (const int32_t t : surface.mesh().fans[ends[0]]) {
    const Triangle& corners = surface.mesh().triangles[t];
    if (std::find(corners.begin(), corners.end(), ends[1]) == corners.end()) continue;
    sum = sum + surface.normal(t, place_on_edge(corners, ends, share));
  }
  return normalized(sum);
}

}  // namespace

FixedSample at_vertex(const CurvedSurface& surface, const Creases& creases, int32_t vertex,
                      const Spacing& spacing) {
  const TriangleMesh& mesh = surface.mesh();
  const int32_t t = mesh.fans[vertex].front();
  const SampleKind kind = creases.corner[vertex]                ? SampleKind::corner
                          : creases.at[vertex] == Crease::none  ? SampleKind::vertex
                          : creases.at[vertex] == Crease::sharp ? SampleKind::sharp
                                                                : SampleKind::boundary;
  return {kind,
          t,
          place_on_edge(mesh.triangles[t], {vertex, -1}, 0),
          mesh.points[vertex],
          normalized(mesh.normal_sum(vertex)),
          kDisk * spacing(mesh.points[vertex])};
}

FixedSample on_edge(const CurvedSurface& surface, const Creases& creases, int32_t edge,
                    double share, const Spacing& spacing) {
  const MeshEdge& e = creases.edges[edge];
  const int32_t t = e.triangles[0];
  const Barycentric at = place_on_edge(surface.mesh().triangles[t], e.ends, share);
  const Vec3 point = surface.point(t, at);
  const auto kind = e.crease == Crease::sharp ? SampleKind::sharp : SampleKind::boundary;
  return {kind, t,    at, point, edge_normal(surface, e.ends, share), kDisk * spacing(point),
          edge, share};
}

FixedSample on_surface(const CurvedSurface& surface, int32_t triangle, const Barycentric& at,
                       const Spacing& spacing) {
  const Vec3 point = surface.point(triangle, at);
  return {SampleKind::surface,   triangle, at, point, surface.normal(triangle, at),
          kDisk * spacing(point)};
}

}  // namespace medial
