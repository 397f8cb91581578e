// SPDX-License-Identifier: GPL-3.0-or-later
#include "cocone/solid.h"

namespace medial {
namespace {

// Returns the faces of the boundary, seen from outside.
FaceSet outer_faces(const Triangulation& t, const CellSides& sides, const Run& run) {
  FaceSet result(t);
  parallel_for(t.cell_count(), run, [&](int64_t c) {
    for (int i = 0; i < 4; ++i) {
      const CellFace f{static_cast<int32_t>(c), i};
      if (sides[c] != Side::inner && sides[t.neighbors[c][i]] == Side::inner) result.insert(f);
    }
  });
  return result;
}

std::vector<Triangle> triangles_of(const Triangulation& t, const FaceSet& outer) {
  std::vector<Triangle> triangles;
  for_faces(t, outer, [&](const CellFace& f) { triangles.push_back(corners(t, f)); });
  return triangles;
}

// Returns for each sample whether the triangles around it are not one disc.
std::vector<uint8_t> nonmanifold(const Triangulation& t, const Csr<int32_t>& incident,
                                 const FaceSet& outer, const Run& run) {
  std::vector<uint8_t> result(static_cast<size_t>(incident.size()));
  parallel_chunks(incident.size(), run, [&](int64_t begin, int64_t end, int) {
    std::vector<CellFace> faces;
    std::vector<Edge> links;
    for (auto p = static_cast<int32_t>(begin); p < end; ++p) {
      faces.clear();
      for_faces_at(p, t, incident[p], outer, [&](const CellFace& f) { faces.push_back(f); });
      result[p] = !faces.empty() && !is_one_disc(t, faces, p, links);
    }
  });
  return result;
}

// Counts edges with more than two triangles. Only edges between two non-manifold samples are
// checked, because both ends of such an edge are always non-manifold.
int64_t count_nonmanifold_edges(std::span<const Triangle> triangles,
                                std::span<const uint8_t> nonmanifold) {
  std::vector<Edge> edges;
  for (const Triangle& t : triangles) {
    for (const int32_t corner : t) {
      const auto [p, q] = link_of(t, corner);
      if (nonmanifold[p] && nonmanifold[q]) edges.push_back({std::min(p, q), std::max(p, q)});
    }
  }
  std::sort(edges.begin(), edges.end());
  int64_t count = 0;
  for (size_t i = 2; i < edges.size(); ++i) {
    // An edge counts once, at the third of its copies.
    const bool third = edges[i] == edges[i - 2] && (i == 2 || edges[i] != edges[i - 3]);
    count += third;
  }
  return count;
}

}  // namespace

std::vector<Triangle> boundary_triangles(const Triangulation& t, const CellSides& sides,
                                         const Run& run) {
  return triangles_of(t, outer_faces(t, sides, run));
}

SolidBoundary solid_boundary(const Triangulation& t, const Csr<int32_t>& incident,
                             const CellSides& sides, const Run& run) {
  const FaceSet outer = outer_faces(t, sides, run);
  SolidBoundary result;
  result.on_surface.assign(static_cast<size_t>(incident.size()), 0);
  result.triangles = triangles_of(t, outer);
  for (const Triangle& triangle : result.triangles) {
    for (const int32_t p : triangle) result.on_surface[p] = 1;
  }
  const auto bad = nonmanifold(t, incident, outer, run);
  result.nonmanifold_vertices = std::count(bad.begin(), bad.end(), 1);
  result.nonmanifold_edges = count_nonmanifold_edges(result.triangles, bad);
  for (int64_t p = 0; p < incident.size(); ++p) {
    const auto cells = incident[p];
    result.left_outside += std::none_of(cells.begin(), cells.end(),
                                        [&](int32_t cell) { return sides[cell] == Side::inner; });
  }
  result.inner_cells = std::count(sides.begin(), sides.end(), Side::inner);
  return result;
}

}  // namespace medial
