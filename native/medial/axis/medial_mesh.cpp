// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/medial_mesh.h"

#include <climits>

#include "delaunay/circumcentre.h"

namespace medial {
namespace {

// These polygons are dual to the edges of one chunk of samples; the corners are lowest cells of
// Voronoi vertices.
struct Polygons {
  Array<int32_t> corners, sizes, edges;
  Array<FacetAttributes> attributes;
  int64_t unbounded = 0, zero_area = 0, rings = 0;

  // Returns a copy without spare capacity, in the arena of a run.
  Polygons packed(const Run& run) const {
    return {pack(corners, run),
            pack(sizes, run),
            pack(edges, run),
            pack(attributes, run),
            unbounded,
            zero_area,
            rings};
  }
  void clear() {
    for (auto* values : {&corners, &sizes, &edges}) values->clear();
    attributes.clear();
    unbounded = zero_area = rings = 0;
  }
};

// Finds the distinct Voronoi vertices of a ring. All edges between equal ones have length zero,
// even if these are not consecutive: the polygon is convex, so everything on one side between them
// coincides, too.
void distinct_vertices(const std::vector<int32_t>& ring, const Voronoi& voronoi,
                       std::vector<int32_t>& polygon) {
  polygon = ring;
  bool own = true;  // every cell has a vertex of its own
  for (const int32_t cell : ring) own &= voronoi.vertex[cell] == cell;
  if (own) return;
  polygon.clear();
  for (const int32_t cell : ring) {
    const int32_t v = voronoi.vertex[cell];
    if (std::find(polygon.begin(), polygon.end(), v) == polygon.end()) polygon.push_back(v);
  }
}

// Returns whether points are indistinguishable from points on one line, given their errors.
bool are_on_a_line(std::span<const Circumcentre> found) {
  const Circumcentre& start = found[0];
  const auto nearer = [&](const Circumcentre& a, const Circumcentre& b) {
    return squared_length(a.centre - start.centre) < squared_length(b.centre - start.centre);
  };
  const Circumcentre& far = *std::max_element(found.begin(), found.end(), nearer);
  const Vec3 along = normalized(far.centre - start.centre);
  return std::all_of(found.begin(), found.end(), [&](const Circumcentre& o) {
    return length(cross(o.centre - start.centre, along)) <= start.error + far.error + o.error;
  });
}

// Returns whether the vertices of a polygon are indistinguishable from points on one line, even by
// finer centres. This happens for samples that are symmetric about the line.
bool is_on_a_line(const std::vector<int32_t>& polygon, std::span<const Vec3> points,
                  const Triangulation& t) {
  std::vector<Circumcentre> found;
  for (const double coarsest : {kCoarsestError, kFinestError}) {
    found.clear();
    for (const int32_t v : polygon) {
      const auto& [i, j, k, l] = t.cells[v];
      found.push_back(circumcentre(points[i], points[j], points[k], points[l], coarsest));
    }
    if (!are_on_a_line(found)) return false;
  }
  return true;
}

// Returns whether three vertices suffice to show that a polygon is not on a line: if they were
// within four of the coarsest errors of the largest ball of one, the parallelogram of a and b would
// be at most that times |a| + |b|.
bool is_wide(const std::vector<int32_t>& polygon, std::span<const Vec3> points,
             const Triangulation& t, const Voronoi& voronoi) {
  const Vec3& start = voronoi.centre[polygon[0]];
  const Vec3 a = voronoi.centre[polygon[1]] - start, b = voronoi.centre[polygon[2]] - start;
  double farthest = squared_length(start - points[t.cells[polygon[0]][0]]);
  for (const int32_t v : polygon) {
    farthest = std::max(farthest, squared_length(voronoi.centre[v] - start));
  }
  const double clear = 16 * kCoarsestError;
  return squared_length(cross(a, b)) >
         clear * clear * farthest * (squared_length(a) + squared_length(b));
}

// This makes facets, one after the other.
class FacetMaker {
 public:
  FacetMaker(const Selection& selection, std::span<const Vec3> points, const Triangulation& t,
             const Voronoi& voronoi, const Edges& edges)
      : selection_(selection), points_(points), t_(t), voronoi_(voronoi), edges_(edges) {}

  // Returns the number of corners, or 0 if there is no facet.
  int32_t append(int32_t edge, Polygons& out) {
    const bool wanted = selection_.wants(edge, ring_);
    if (wanted && ring_.empty()) ring_of_cells(t_, edges_.ends[edge], edges_.cell[edge], ring_);
    out.rings += !ring_.empty();
    if (!wanted) return 0;
    if (t_.is_infinite(edges_.cell[edge])) {
      ++out.unbounded;
      return 0;
    }
    distinct_vertices(ring_, voronoi_, polygon_);
    if (polygon_.size() < 3 ||
        (!is_wide(polygon_, points_, t_, voronoi_) && is_on_a_line(polygon_, points_, t_))) {
      ++out.zero_area;
      return 0;
    }
    out.corners.insert(out.corners.end(), polygon_.begin(), polygon_.end());
    out.sizes.push_back(static_cast<int32_t>(polygon_.size()));
    out.edges.push_back(edge);
    out.attributes.push_back(selection_.attributes(edge, ring_));
    return out.sizes.back();
  }

 private:
  const Selection& selection_;
  std::span<const Vec3> points_;
  const Triangulation& t_;
  const Voronoi& voronoi_;
  const Edges& edges_;
  std::vector<int32_t> ring_, polygon_;
};

// This holds the polygons in the order of the samples, which is that of the cells, and the
// positions of the faces and corners of each row.
struct Found {
  std::vector<Polygons> chunks;
  Array<int32_t> faces, corners;  // (rows + 1)
};

Found find_polygons(const Selection& selection, const Samples& samples, const Triangulation& t,
                    const Voronoi& voronoi, const Edges& edges, const Run& run) {
  const int64_t count = samples.count();
  const size_t rows = samples.point_of_row.size();
  Found found{std::vector<Polygons>(static_cast<size_t>((count + kGrain - 1) / kGrain)),
              array<int32_t>(rows + 1, 0, run), array<int32_t>(rows + 1, 0, run)};
  std::vector<Polygons> rooms(run.threads);
  parallel_chunks(count, run, [&](int64_t begin, int64_t end, int worker) {
    FacetMaker maker(selection, samples.points, t, voronoi, edges);
    Polygons& out = rooms[worker];
    out.clear();
    for (int64_t p = begin; p < end; ++p) {
      const int32_t row = samples.row[p];
      for (int32_t e = edges.first[p]; e < edges.first[p + 1]; ++e) {
        const int32_t size = maker.append(e, out);
        found.faces[row] += size > 0;
        found.corners[row] += size;
      }
    }
    found.chunks[static_cast<size_t>(begin / kGrain)] = out.packed(run);
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

// Copies one chunk into the order of the rows.
void place(const Polygons& chunk, const Found& found, std::span<const int32_t> row,
           const Edges& edges, MedialMesh& mesh) {
  auto corner = chunk.corners.begin();
  int32_t last = -1, f = 0, c = 0;
  for (size_t i = 0; i < chunk.edges.size(); ++i) {
    const auto& [p, q] = edges.ends[chunk.edges[i]];
    if (p != last) f = found.faces[row[p]], c = found.corners[row[p]];
    last = p;
    mesh.theta[f] = chunk.attributes[i].theta;
    mesh.rho[f] = chunk.attributes[i].rho;
    mesh.side[f] = chunk.attributes[i].side;
    mesh.generators[f] = {row[p], row[q]};
    mesh.face_offsets[f++] = c;
    std::copy_n(corner, chunk.sizes[i], mesh.face_vertices.begin() + c);
    corner += chunk.sizes[i];
    c += chunk.sizes[i];
  }
}

MedialMesh in_order(Found found, std::span<const int32_t> row, const Edges& edges, const Run& run) {
  require_few_corners(found);
  counts_to_offsets(found.faces);
  counts_to_offsets(found.corners);
  MedialMesh mesh;
  const auto faces = static_cast<size_t>(found.faces.back());
  for (auto* values : {&mesh.theta, &mesh.rho}) values->resize(faces);
  mesh.side.resize(faces);
  mesh.generators.resize(faces);
  mesh.face_offsets.resize(faces + 1);
  mesh.face_vertices.resize(static_cast<size_t>(found.corners.back()));
  mesh.face_offsets.back() = found.corners.back();
  parallel_for(
      static_cast<int64_t>(found.chunks.size()), run,
      [&](int64_t i) { place(found.chunks[i], found, row, edges, mesh); }, 1);
  for (const Polygons& chunk : found.chunks) {
    mesh.unbounded += chunk.unbounded;
    mesh.zero_area += chunk.zero_area;
    mesh.rings += chunk.rings;
  }
  return mesh;
}

// Numbers the Voronoi vertices in order of first use and replaces cells by these numbers. Returns
// the number of each cell, and how many there are.
std::pair<Array<int32_t>, int32_t> number_vertices(std::span<int32_t> corners, int32_t cells,
                                                   const Run& run) {
  auto number = array<int32_t>(static_cast<size_t>(cells), -1, run);
  int32_t count = 0;
  for (int32_t& corner : corners) {
    if (number[corner] < 0) number[corner] = count++;
    corner = number[corner];
  }
  return {std::move(number), count};
}

void add_vertices(MedialMesh& mesh, const Samples& samples, const Triangulation& t,
                  const Voronoi& voronoi, const Run& run) {
  const auto [number, count] = number_vertices(mesh.face_vertices, t.cell_count(), run);
  mesh.vertices.resize(static_cast<size_t>(count));
  mesh.radius.resize(static_cast<size_t>(count));
  parallel_for(t.finite_cells, run, [&, &number = number](int64_t c) {
    if (number[c] < 0) return;
    mesh.vertices[number[c]] = voronoi.centre[c];
    mesh.radius[number[c]] = distance(voronoi.centre[c], samples.points[t.cells[c][0]]);
  });
}

void start_at_lowest(MedialMesh& mesh, const Run& run) {
  parallel_for(static_cast<int64_t>(mesh.face_offsets.size()) - 1, run, [&](int64_t f) {
    const auto begin = mesh.face_vertices.begin() + mesh.face_offsets[f];
    const auto end = mesh.face_vertices.begin() + mesh.face_offsets[f + 1];
    std::rotate(begin, std::min_element(begin, end), end);
  });
}

}  // namespace

MedialMesh voronoi_facets(const Selection& selection, const Samples& samples,
                          const Triangulation& t, const Voronoi& voronoi, const Edges& edges,
                          const Run& run) {
  const Run quiet{run.threads, nullptr, run.arena};
  MedialMesh mesh = in_order(find_polygons(selection, samples, t, voronoi, edges, run), samples.row,
                             edges, quiet);
  throw_if_cancelled(run.progress);
  add_vertices(mesh, samples, t, voronoi, quiet);
  start_at_lowest(mesh, quiet);
  return mesh;
}

}  // namespace medial
