#include "medial_mesh.h"

#include <climits>

#include "circumcentre.h"

namespace medial {
namespace {

// Polygons of the edges from one chunk of samples; corners are lowest cells of Voronoi vertices.
struct Polygons {
  std::vector<int32_t> corners, sizes, edges;
  std::vector<Side> sides;
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
  double farthest = 0;
  for (const int32_t v : polygon) {
    const double d = squared_length(voronoi.centre[v] - start);
    if (d > farthest) farthest = d, far = v;
  }
  const Vec3 along = normalized(voronoi.centre[far] - start);
  const double radius = distance(start, points[t.cells[polygon[0]][0]]);
  // Beyond all rounding of the largest of their balls.
  const double clear = 4 * kCoarsestError * (radius + std::sqrt(farthest));
  const auto squared_beside = [&](int32_t v) {
    return squared_length(cross(voronoi.centre[v] - start, along));
  };
  for (const int32_t v : polygon) {
    if (squared_beside(v) > clear * clear) return false;
  }
  const double ends = error_of(polygon[0], points, t) + error_of(far, points, t);
  return std::all_of(polygon.begin(), polygon.end(), [&](int32_t v) {
    return std::sqrt(squared_beside(v)) <= ends + error_of(v, points, t);
  });
}

// Makes facets, one after the other.
class FacetMaker {
 public:
  FacetMaker(const FacetChoice& choice, std::span<const Vec3> points, const Triangulation& t,
             const Voronoi& voronoi, const Edges& edges)
      : choice_(choice), points_(points), t_(t), voronoi_(voronoi), edges_(edges) {}

  // The number of corners; 0 without a facet.
  int32_t append(int32_t edge, Polygons& out) {
    if (!choice_.maybe(edge)) return 0;
    ring_of_cells(t_, edges_.ends[edge], edges_.cell[edge], ring_);
    const auto side = choice_.side(edge, ring_);
    if (!side) return 0;
    if (t_.is_infinite(edges_.cell[edge])) {
      ++out.unbounded;
      return 0;
    }
    distinct_vertices(ring_, voronoi_, polygon_);
    if (polygon_.size() < 3 || is_on_a_line(polygon_, points_, t_, voronoi_)) {
      ++out.zero_area;
      return 0;
    }
    out.corners.insert(out.corners.end(), polygon_.begin(), polygon_.end());
    out.sizes.push_back(static_cast<int32_t>(polygon_.size()));
    out.edges.push_back(edge);
    out.sides.push_back(*side);
    return out.sizes.back();
  }

 private:
  const FacetChoice& choice_;
  std::span<const Vec3> points_;
  const Triangulation& t_;
  const Voronoi& voronoi_;
  const Edges& edges_;
  std::vector<int32_t> ring_, polygon_;
};

// Polygons in the order of the samples, which is that of the cells, and where they belong: faces
// and corners from each row on.
struct Found {
  std::vector<Polygons> chunks;
  Array<int32_t> faces, corners;  // (rows + 1)
};

Found find_polygons(const FacetChoice& choice, const Samples& samples, const Triangulation& t,
                    const Voronoi& voronoi, const Edges& edges, const Run& run) {
  const int64_t count = samples.count();
  const size_t rows = samples.sample_of_row.size();
  Found found{std::vector<Polygons>(static_cast<size_t>((count + kGrain - 1) / kGrain)),
              array<int32_t>(rows + 1, 0, run), array<int32_t>(rows + 1, 0, run)};
  parallel_chunks(count, run, [&](int64_t begin, int64_t end, int) {
    FacetMaker maker(choice, samples.points, t, voronoi, edges);
    Polygons& out = found.chunks[static_cast<size_t>(begin / kGrain)];
    for (int64_t p = begin; p < end; ++p) {
      const int32_t row = samples.row[p];
      for (int32_t e = edges.from[p][0]; e < edges.from[p][1]; ++e) {
        const int32_t size = maker.append(e, out);
        found.faces[row] += size > 0;
        found.corners[row] += size;
      }
    }
  });
  return found;
}

void require_few_corners(const Found& found) {
  size_t corners = 0;
  for (const Polygons& chunk : found.chunks) corners += chunk.corners.size();
  if (corners > INT_MAX) {
    throw InvalidInputError("Expected fewer than 2^31 facet corners, found " +
                            std::to_string(corners) + "; raise the thresholds or thin the points.");
  }
}

// One chunk into the order of the rows.
void place(const Polygons& chunk, const Found& found, const Samples& samples, const Edges& edges,
           Facets& facets) {
  MedialMesh& mesh = facets.mesh;
  auto corner = chunk.corners.begin();
  int32_t last = -1, f = 0, c = 0;
  for (size_t i = 0; i < chunk.edges.size(); ++i) {
    const int32_t p = edges.ends[chunk.edges[i]][0];
    if (p != last) f = found.faces[samples.row[p]], c = found.corners[samples.row[p]];
    last = p;
    facets.edges[f] = chunk.edges[i];
    mesh.side[f] = chunk.sides[i];
    mesh.face_offsets[f++] = c;
    std::copy_n(corner, chunk.sizes[i], mesh.face_vertices.begin() + c);
    corner += chunk.sizes[i];
    c += chunk.sizes[i];
  }
}

Facets in_order(Found found, const Samples& samples, const Edges& edges, const Run& run) {
  require_few_corners(found);
  counts_to_offsets(found.faces);
  counts_to_offsets(found.corners);
  Facets facets;
  MedialMesh& mesh = facets.mesh;
  const auto faces = static_cast<size_t>(found.faces.back());
  facets.edges = array<int32_t>(faces, run);
  mesh.side.resize(faces);
  mesh.face_offsets.resize(faces + 1);
  mesh.face_vertices.resize(static_cast<size_t>(found.corners.back()));
  mesh.face_offsets.back() = found.corners.back();
  parallel_for(
      static_cast<int64_t>(found.chunks.size()), run,
      [&](int64_t i) { place(found.chunks[i], found, samples, edges, facets); }, 1);
  for (const Polygons& chunk : found.chunks) {
    mesh.unbounded += chunk.unbounded;
    mesh.zero_area += chunk.zero_area;
  }
  return facets;
}

// Numbers the Voronoi vertices in order of first use and replaces cells by these numbers.
Array<int32_t> number_vertices(Array<int32_t>& corners, int32_t cells, const Run& run) {
  auto number = array<int32_t>(static_cast<size_t>(cells), -1, run);
  auto used = array<int32_t>(0, run);
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

Facets voronoi_facets(const FacetChoice& choice, const Samples& samples, const Triangulation& t,
                      const Voronoi& voronoi, const Edges& edges, const Run& run) {
  Facets facets = in_order(find_polygons(choice, samples, t, voronoi, edges, run), samples, edges,
                           {run.threads, nullptr, run.heap});
  MedialMesh& mesh = facets.mesh;
  const auto used = number_vertices(mesh.face_vertices, t.cell_count(), run);
  start_at_lowest(mesh, run);
  mesh.vertices.resize(used.size());
  mesh.radius.resize(used.size());
  parallel_for(static_cast<int64_t>(used.size()), run, [&](int64_t v) {
    mesh.vertices[v] = voronoi.centre[used[v]];
    mesh.radius[v] = distance(mesh.vertices[v], samples.points[t.cells[used[v]][0]]);
  });
  return facets;
}

}  // namespace medial
