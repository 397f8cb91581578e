#include "medial_mesh.h"

#include <climits>

#include "circumcentre.h"

namespace medial {
namespace {

// Polygons of one chunk of facets; corners are lowest cells of Voronoi vertices.
struct Polygons {
  std::vector<int32_t> corners, sizes, edges;
  int64_t unbounded = 0, zero_area = 0;
};

// The distinct Voronoi vertices of a ring. All edges between equal ones have length zero, also
// where the equal ones are not consecutive: the polygon is convex, so everything on one side
// between them coincides too.
void distinct_vertices(const std::vector<int32_t>& ring, const Voronoi& voronoi,
                       std::vector<int32_t>& polygon) {
  polygon.clear();
  for (const int32_t cell : ring) {
    const int32_t v = voronoi.vertex[cell];
    if (std::find(polygon.begin(), polygon.end(), v) == polygon.end()) polygon.push_back(v);
  }
}

// How far rounding may have moved the centre of a cell.
double error_of(int32_t cell, std::span<const Vec3> points, const Triangulation& t) {
  const auto& [i, j, k, l] = t.cells[cell];
  return circumcentre(points[i], points[j], points[k], points[l]).error;
}

// Whether the vertices of a polygon cannot be told from points of one line, as of samples that lie
// symmetrically about it.
bool is_on_a_line(const std::vector<int32_t>& polygon, std::span<const Vec3> points,
                  const Triangulation& t, const Voronoi& voronoi) {
  const Vec3& start = voronoi.centre[polygon[0]];
  int32_t far = polygon[1];
  for (const int32_t v : polygon) {
    if (distance(start, voronoi.centre[v]) > distance(start, voronoi.centre[far])) far = v;
  }
  const Vec3 along = normalized(voronoi.centre[far] - start);
  const auto beside = [&](int32_t v) { return length(cross(voronoi.centre[v] - start, along)); };
  double widest = 0;
  for (const int32_t v : polygon) widest = std::max(widest, beside(v));
  const double radius = distance(start, points[t.cells[polygon[0]][0]]);
  const double largest = radius + distance(start, voronoi.centre[far]);  // of all their balls
  if (widest > 4 * kCoarsestError * largest) return false;               // beyond all rounding
  const double ends = error_of(polygon[0], points, t) + error_of(far, points, t);
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](int32_t v) { return beside(v) <= ends + error_of(v, points, t); });
}

void append_facet(int32_t edge, std::span<const Vec3> points, const Triangulation& t,
                  const Voronoi& voronoi, const Edges& edges, std::vector<int32_t>& ring,
                  std::vector<int32_t>& polygon, Polygons& out) {
  if (t.is_infinite(edges.cell[edge])) {
    ++out.unbounded;
    return;
  }
  ring_of_cells(t, edges.ends[edge], edges.cell[edge], ring);
  distinct_vertices(ring, voronoi, polygon);
  if (polygon.size() < 3 || is_on_a_line(polygon, points, t, voronoi)) {
    ++out.zero_area;
    return;
  }
  out.corners.insert(out.corners.end(), polygon.begin(), polygon.end());
  out.sizes.push_back(static_cast<int32_t>(polygon.size()));
  out.edges.push_back(edge);
}

std::vector<Polygons> polygons(std::span<const int32_t> edge_ids, std::span<const Vec3> points,
                               const Triangulation& t, const Voronoi& voronoi, const Edges& edges,
                               const Run& run) {
  const auto count = static_cast<int64_t>(edge_ids.size());
  std::vector<Polygons> parts(static_cast<size_t>((count + kGrain - 1) / kGrain));
  parallel_chunks(count, run, [&](int64_t begin, int64_t end, int) {
    std::vector<int32_t> ring, polygon;
    for (int64_t i = begin; i < end; ++i) {
      append_facet(edge_ids[i], points, t, voronoi, edges, ring, polygon, parts[begin / kGrain]);
    }
  });
  return parts;
}

void concatenate(std::vector<Polygons>& parts, Facets& facets) {
  MedialMesh& mesh = facets.mesh;
  size_t corners = 0, faces = 0;
  for (const Polygons& part : parts) {
    corners += part.corners.size();
    faces += part.sizes.size();
  }
  if (corners > INT_MAX) {
    throw InvalidInputError("Expected fewer than 2^31 facet corners, found " +
                            std::to_string(corners) + "; raise the thresholds or thin the points.");
  }
  mesh.face_vertices.reserve(corners);
  mesh.face_offsets.reserve(faces + 1);
  facets.edges.reserve(faces);
  mesh.face_offsets.push_back(0);
  for (Polygons& part : parts) {
    mesh.face_vertices.insert(mesh.face_vertices.end(), part.corners.begin(), part.corners.end());
    facets.edges.insert(facets.edges.end(), part.edges.begin(), part.edges.end());
    for (const int32_t size : part.sizes)
      mesh.face_offsets.push_back(mesh.face_offsets.back() + size);
    mesh.unbounded += part.unbounded;
    mesh.zero_area += part.zero_area;
    part = {};
  }
}

// Numbers the Voronoi vertices in order of first use and replaces cells by these numbers.
std::vector<int32_t> number_vertices(std::vector<int32_t>& corners, int32_t cells) {
  std::vector<int32_t> number(static_cast<size_t>(cells), -1), used;
  for (int32_t& corner : corners) {
    if (number[corner] < 0) {
      number[corner] = static_cast<int32_t>(used.size());
      used.push_back(corner);
    }
    corner = number[corner];
  }
  return used;
}

void start_at_lowest(MedialMesh& mesh, const Run& run) {
  parallel_for(static_cast<int64_t>(mesh.face_offsets.size()) - 1, run, [&](int64_t f) {
    const auto begin = mesh.face_vertices.begin() + mesh.face_offsets[f];
    const auto end = mesh.face_vertices.begin() + mesh.face_offsets[f + 1];
    std::rotate(begin, std::min_element(begin, end), end);
  });
}

}  // namespace

Facets voronoi_facets(std::span<const int32_t> edge_ids, std::span<const Vec3> points,
                      const Triangulation& t, const Voronoi& voronoi, const Edges& edges,
                      const Run& run) {
  Facets facets;
  auto parts = polygons(edge_ids, points, t, voronoi, edges, run);
  concatenate(parts, facets);
  MedialMesh& mesh = facets.mesh;
  const auto used = number_vertices(mesh.face_vertices, t.cell_count());
  start_at_lowest(mesh, run);
  mesh.vertices.resize(used.size());
  mesh.radius.resize(used.size());
  parallel_for(static_cast<int64_t>(used.size()), run, [&](int64_t v) {
    mesh.vertices[v] = voronoi.centre[used[v]];
    mesh.radius[v] = distance(mesh.vertices[v], points[t.cells[used[v]][0]]);
  });
  return facets;
}

}  // namespace medial
