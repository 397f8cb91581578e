// SPDX-License-Identifier: GPL-3.0-or-later
// The stages by themselves, for study and tests: each starts from the points and ends with ids of
// input rows.
#include <medial/power_shape.h>

#include "arrays.h"
#include "axis/umbrellas.h"
#include "base/polygon_edges.h"
#include "base/rows.h"
#include "base/triangle_tree.h"
#include "bindings.h"
#include "cocone/cocone.h"
#include "delaunay/polygon_triangles.h"
#include "delaunay/samples.h"
#include "inside/buried.h"
#include "inside/solid_betti.h"
#include "inside/surface.h"
#include "inside/walls.h"
#include "inside/winding_number.h"

namespace medial::python {
namespace {

constexpr const char* kDelaunayDoc =
    "Delaunay triangulation of the distinct rows.\n\nReturns\n-------\n"
    "cells : (c, 4) int32\n    Rows of the corners, positively oriented; -1 is the infinite "
    "vertex.\n"
    "neighbors : (c, 4) int32\n    Cell across the facet opposite to each corner.\n"
    "circumcentres : (c, 3) float64\n    Voronoi vertex of a finite cell; of an infinite cell the "
    "outward unit normal of\n"
    "    its hull triangle: the direction of its Voronoi ray.";

constexpr const char* kPolesDoc =
    "Pole vectors (Definition 1) of the distinct rows in ascending order.\n\nReturns\n-------\n"
    "vectors : (k, 3) float64\n    v_p = p+ - p; for an unbounded cell the mean of the unit "
    "directions of its distinct\n"
    "    infinite edges.\n"
    "unbounded : (k,) bool\n    The pole is at infinity.";

constexpr const char* kUmbrellasDoc =
    "Umbrellas U_p (Definition 3) of the distinct rows in ascending order.\n\nReturns\n-------\n"
    "offsets : (k + 1,) int64\n"
    "triangles : (t, 3) int32\n    Rows (p, a, b), a < b, sorted; U_p of the i-th sample is\n"
    "    triangles[offsets[i] : offsets[i + 1]].";

constexpr const char* kPowerShapeDoc =
    "The power shape (Amenta, Choi & Kolluri 2001): where the power cells of balls meet.\n\n"
    "Parameters\n----------\ncentres : (n, 3) float64\nradii : (n,) float64\n"
    "wanted : (n,) bool\n    The balls of the shape, say the inner poles; the others take their "
    "cells of space.\n"
    "progress : Progress, optional\n\nReturns\n-------\n"
    "balls : (k,) int32\n    Rows, ascending, of the wanted balls that have a cell.\n"
    "triangles : (t, 3) int32\n    Rows of three wanted balls whose cells meet, ascending.\n"
    "edges : (e, 2) int32\n    Of two, in no such triangle.\n\n"
    "Raises\n------\nInvalidInputError, Cancelled";

constexpr const char* kCoconeDoc =
    "Cocone's flat samples and candidate triangles; samples are the distinct rows in ascending "
    "order.\n\n"
    "With v_p the pole vector and C_p the points y whose line p y is within `cocone_angle` of the "
    "plane through p\n"
    "normal to v_p, the cocone neighbours of p are the samples of the triangles at p whose dual "
    "Voronoi edge\nmeets C_p.\n\n"
    "Returns\n-------\n"
    "thin : (k,) bool\n    `flatness_ratio` times the distance of the farthest crossing of V_p's "
    "edges with that plane is at\n    most the distance of p to its pole and to its second "
    "pole.\n"
    "flat : (k,) bool\n    Thin, and its pole line is within `flatness_angle` of that of every "
    "cocone neighbour; or, grown\n    from those: thin, and within it of that of one flat cocone "
    "neighbour.\n"
    "candidates : (t, 3) int32\n    Rows, ascending, sorted: triangles with a flat corner, whose "
    "dual Voronoi edge meets the cocone of\n    every flat corner.";

constexpr const char* kOpenEdgesDoc =
    "MedialAnalysis.boundary_edges without the analysis: edges of the triangles that are not used "
    "equally often in\n"
    "both directions, rows with the same coordinates being one. 0: the surface is closed, or there "
    "is none.\n\n"
    "Parameters\n----------\npoints : (n, 3) float64\ntriangles : (m, 3) int32";

constexpr const char* kSolidBettiDoc =
    "Pieces, loops and cavities of the solid whose boundary the triangles are, if they pass "
    "nowhere "
    "through themselves;\nNone where they are no closed manifold, or a shell of them has no "
    "volume. "
    "Rows with the same coordinates are one.\n\n"
    "Parameters\n----------\npoints : (n, 3) float64\ntriangles : (m, 3) int32";

constexpr const char* kWindingDoc =
    "Generalized winding number of a triangle soup at each query: 1 inside an outward one.\n\n"
    "Parameters\n----------\n"
    "queries : (q, 3) float64\nvertices : (v, 3) float64\ntriangles : (m, 3) "
    "int32\n\nReturns\n-------\n"
    "winding : (q,) float64\n    Sum of the solid angles over 4 pi, up to rounding.";

constexpr const char* kBuriedDoc =
    "Where triangles are no boundary of the solid: overlapping shells, walls inside, sheets "
    "without thickness.\n\n"
    "Parameters\n----------\npoints : (n, 3) float64\nnormals : (n, 3) float64\noffset : "
    "float\nvertices : (v, 3) float64\n"
    "triangles : (m, 3) int32\nprogress : Progress, optional\nthreads : int\n\n"
    "Returns\n-------\nburied : (n,) bool\n    The winding number is above 1/2 on both sides of "
    "the surface, at points +- offset * normals, or on\n    neither. False for a zero normal.\n\n"
    "Raises\n------\nInvalidInputError, Cancelled";

constexpr const char* kSurfaceDistanceDoc =
    "(q,) float64: how far each query is from the nearest triangle.\n\n"
    "Parameters\n----------\nqueries : (q, 3) float64\nvertices : (v, 3) float64\n"
    "triangles : (m, 3) int32\n    One at least; they may be without area.\n"
    "progress : Progress, optional\nthreads : int\n"
    "    0: as many as the machine has. The result does not depend on it.\n\n"
    "Raises\n------\nInvalidInputError, Cancelled";

constexpr const char* kWallsDoc =
    "How thick a solid is behind points of its surface.\n\n"
    "Parameters\n----------\npoints : (n, 3) float64\nnormals : (n, 3) float64\n    Unit, "
    "outward.\nreach : (n,) float64\n    How far one looks.\n"
    "vertices : (v, 3) float64\ntriangles : (m, 3) int32\nprogress : Progress, "
    "optional\nthreads : int\n\nReturns\n-------\ndistances : (n,) float64\n    Infinite "
    "where there is no such wall within reach.\n\n"
    "Raises\n------\nInvalidInputError, Cancelled";

constexpr const char* kPolygonEdgesDoc =
    "The edges of polygons that share vertices, as of a `MedialMesh`.\n\n"
    "Parameters\n----------\nface_offsets : (f + 1,) int32\nface_vertices : (c,) int32\n"
    "vertices : int\n    Number of vertices; every corner is below it.\n\n"
    "Returns\n-------\nedges : (e, 2) int32\n    Lower vertex first, in lexicographic order.\n"
    "corner_edges : (c,) int32\n    The row of the edge from each corner to the next one of its "
    "polygon.\n\n"
    "Raises\n------\nInvalidInputError";

constexpr const char* kPolygonTrianglesDoc =
    "Polygons as triangles, without new vertices.\n\n"
    "Parameters\n----------\npoints : (n, 3) float64\nface_offsets : (f + 1,) int32\n"
    "face_vertices : (c,) int32\n    Rows of `points`, three at least for each polygon.\n\n"
    "Returns\n-------\ntriangles : (c - 2 f, 3) int32\n"
    "    Polygon after polygon, each with its boundary and turning as it does. Quads are cut from "
    "the first corner to the\n    third, where they are convex there; larger ones by their "
    "constrained Delaunay triangulation.\n\n"
    "Raises\n------\nInvalidInputError";

Run all_cores() { return {thread_count(0), nullptr}; }

std::span<const Vec3> with_volume(std::span<const Vec3> points) {
  require_volume(points);
  return points;
}

// The pipeline up to the umbrellas.
struct Stages {
  explicit Stages(std::span<const Vec3> rows)
      : samples(make_samples(rows, all_cores())),
        triangulation(triangulate(with_volume(samples.points), all_cores())),
        voronoi(medial::voronoi(samples.points, triangulation, all_cores())),
        incident(incident_cells(triangulation, samples.count(), all_cores())) {}

  std::vector<int32_t> by_row() const { return samples_by_row(samples); }
  Poles poles() const {
    return medial::poles(samples.points, triangulation, voronoi, incident, all_cores());
  }

  Samples samples;
  Triangulation triangulation;
  Voronoi voronoi;
  Csr<int32_t> incident;
};

Array<Cell> cell_rows(const Stages& stages) {
  auto rows = stages.triangulation.cells;
  for (Cell& cell : rows) {
    for (int32_t& id : cell) id = id == kInfinite ? kInfinite : stages.samples.row[id];
  }
  return rows;
}

py::tuple delaunay(const py::object& points) {
  const Points rows(points, "points");
  auto stages = [&, span = rows.span()] {
    const py::gil_scoped_release release;
    return Stages(span);
  }();
  return py::make_tuple(array_of<int32_t>(cell_rows(stages)),
                        array_of<int32_t>(std::move(stages.triangulation.neighbors)),
                        array_of<double>(std::move(stages.voronoi.centre)));
}

py::tuple pole_vectors(const py::object& points) {
  const Points rows(points, "points");
  std::vector<Vec3> vectors;
  std::vector<uint8_t> unbounded;
  {
    const auto span = rows.span();
    const py::gil_scoped_release release;
    const Stages stages(span);
    const Poles poles = stages.poles();
    for (const int32_t p : stages.by_row()) {
      vectors.push_back(poles.vector[p]);
      unbounded.push_back(poles.unbounded[p]);
    }
  }
  return py::make_tuple(array_of<double>(std::move(vectors)),
                        array_of<uint8_t>(std::move(unbounded)).attr("view")("bool"));
}

void append_rows(int32_t p, const Umbrellas& umbrellas, const Samples& samples,
                 std::vector<std::array<int32_t, 3>>& out) {
  const auto begin = static_cast<std::ptrdiff_t>(out.size());
  for (const auto& [a, b] : umbrellas[p]) {
    const auto [low, high] = std::minmax(samples.row[a], samples.row[b]);
    out.push_back({samples.row[p], low, high});
  }
  std::sort(out.begin() + begin, out.end());
}

py::tuple umbrella_triangles(const py::object& points) {
  const Points rows(points, "points");
  std::vector<int64_t> offsets{0};
  std::vector<std::array<int32_t, 3>> triangles;
  {
    const auto span = rows.span();
    const py::gil_scoped_release release;
    const Stages s(span);
    const Umbrellas found =
        umbrellas(s.samples.points, s.triangulation, s.voronoi, s.incident, all_cores());
    for (const int32_t p : s.by_row()) {
      append_rows(p, found, s.samples, triangles);
      offsets.push_back(static_cast<int64_t>(triangles.size()));
    }
  }
  return py::make_tuple(array_of<int64_t>(std::move(offsets)),
                        array_of<int32_t>(std::move(triangles)));
}

py::tuple shape_of_balls(const py::object& centres, const py::object& radii,
                         const py::object& wanted, Progress* progress) {
  const Points rows(centres, "centres");
  const auto sizes = column_of<double>(radii, "radii", "(n,) float64");
  const auto flags = flags_of(wanted, "wanted");
  PowerShape found;
  {
    const auto span = rows.span();
    const py::gil_scoped_release release;
    found = power_shape(span, sizes, flags, progress);
  }
  return py::make_tuple(array_of<int32_t>(std::move(found.balls)),
                        array_of<int32_t>(std::move(found.triangles)),
                        array_of<int32_t>(std::move(found.edges)));
}

std::vector<std::array<int32_t, 3>> candidate_rows(const Stages& s, const FaceSet& candidates) {
  std::vector<std::array<int32_t, 3>> rows;
  for_faces(s.triangulation, candidates, [&](const CellFace& f) {
    if (s.triangulation.neighbors[f.cell][f.slot] < f.cell) return;
    auto triangle = corners(s.triangulation, f);
    for (int32_t& id : triangle) id = s.samples.row[id];
    std::sort(triangle.begin(), triangle.end());
    rows.push_back(triangle);
  });
  std::sort(rows.begin(), rows.end());
  return rows;
}

py::array flags_by_row(const Stages& s, const std::vector<uint8_t>& flags) {
  std::vector<uint8_t> ordered;
  for (const int32_t p : s.by_row()) ordered.push_back(flags[p]);
  return array_of<uint8_t>(std::move(ordered)).attr("view")("bool");
}

py::tuple cocone_parts(const py::object& points, const CoconeOptions* options) {
  const Points rows(points, "points");
  const CoconeOptions chosen = options ? *options : CoconeOptions{};
  const auto [stages, found] = [&, span = rows.span()] {
    const py::gil_scoped_release release;
    Stages s(span);
    Cocone c = cocone(s.samples.points, s.triangulation, s.voronoi, s.incident, s.poles(), chosen,
                      all_cores());
    return std::make_pair(std::move(s), std::move(c));
  }();
  return py::make_tuple(flags_by_row(stages, found.thin), flags_by_row(stages, found.flat),
                        array_of<int32_t>(candidate_rows(stages, found.candidates)));
}

int64_t count_open_edges(const py::object& points, const py::object& triangles) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  const auto row_span = rows.span();
  const auto face_span = faces.span();
  const py::gil_scoped_release release;
  return open_edges(row_span, face_span, all_cores());
}

py::object betti_of_solid(const py::object& points, const py::object& triangles) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  const auto betti = [&, row_span = rows.span(), face_span = faces.span()] {
    const py::gil_scoped_release release;
    require_corners(face_span, row_span.size());
    const Samples samples = distinct_rows(row_span, "point", all_cores());
    return solid_betti(make_surface(face_span, samples.point_of_row, samples.count(), all_cores()),
                       samples.points, all_cores());
  }();
  if (!betti) return py::none();
  return py::make_tuple((*betti)[0], (*betti)[1], (*betti)[2]);
}

py::tuple edges_of_polygons(const py::object& face_offsets, const py::object& face_vertices,
                            int32_t vertices) {
  const auto offsets = ids_of(face_offsets, "face_offsets");
  const auto corners = ids_of(face_vertices, "face_vertices");
  PolygonEdges edges = [&] {
    const py::gil_scoped_release release;
    return polygon_edges(offsets, corners, vertices, all_cores());
  }();
  return py::make_tuple(array_of<int32_t>(std::move(edges.ends)),
                        array_of<int32_t>(std::move(edges.of_corner)));
}

py::array triangles_of_polygons(const py::object& points, const py::object& face_offsets,
                                const py::object& face_vertices) {
  const Points rows(points, "points");
  const auto offsets = ids_of(face_offsets, "face_offsets");
  const auto corners = ids_of(face_vertices, "face_vertices");
  auto triangles = [&, span = rows.span()] {
    const py::gil_scoped_release release;
    return polygon_triangles(span, offsets, corners, all_cores());
  }();
  return array_of<int32_t>(std::move(triangles));
}

py::array winding_numbers(const py::object& queries, const py::object& vertices,
                          const py::object& triangles) {
  const Points query_rows(queries, "queries"), vertex_rows(vertices, "vertices");
  const Triangles faces(triangles);
  const auto at = query_rows.span();
  std::vector<double> result(at.size());
  {
    require_finite(at, "query");
    const auto corners = vertex_rows.span();
    require_finite(corners, "vertex");
    const auto face_span = faces.span();
    const py::gil_scoped_release release;
    require_corners(face_span, corners.size());
    const auto fans = rows_containing(face_span, static_cast<int32_t>(corners.size()));
    const WindingNumber winding(corners, face_span, boundary_edges(face_span, fans, all_cores()),
                                nullptr);
    parallel_for(static_cast<int64_t>(at.size()), all_cores(),
                 [&](int64_t i) { result[i] = winding(at[i]); });
  }
  return array_of<double>(std::move(result));
}

py::array buried_points(const py::object& points, const py::object& normals, double offset,
                        const py::object& vertices, const py::object& triangles, Progress* progress,
                        int threads) {
  const Points rows(points, "points"), directions(normals, "normals"),
      corners(vertices, "vertices");
  const Triangles faces(triangles);
  const Run run{thread_count(thread_argument(threads)), progress};
  std::vector<uint8_t> result;
  {
    const auto row_span = rows.span(), direction_span = directions.span();
    const auto corner_span = corners.span();
    const auto face_span = faces.span();
    const py::gil_scoped_release release;
    result = buried(row_span, direction_span, offset, corner_span, face_span, run);
  }
  return array_of<uint8_t>(std::move(result)).attr("view")("bool");
}

py::array surface_distances(const py::object& queries, const py::object& vertices,
                            const py::object& triangles, Progress* progress, int threads) {
  const Points asked(queries, "queries"), corners(vertices, "vertices");
  const Triangles faces(triangles);
  const Run run{thread_count(thread_argument(threads)), progress};
  const auto at = asked.span(), rows = corners.span();
  const auto face_span = faces.span();
  require_finite(at, "queries");
  require_finite(rows, "vertices");
  require_corners(face_span, rows.size());
  if (face_span.empty()) {
    throw InvalidInputError("Expected at least one triangle, found none; pass a surface.");
  }
  std::vector<double> result(at.size());
  {
    const py::gil_scoped_release release;
    const TriangleTree tree(rows, face_span);
    parallel_for(static_cast<int64_t>(at.size()), run,
                 [&](int64_t i) { result[i] = tree.distance(at[i]); });
  }
  return array_of<double>(std::move(result));
}

py::array distances_of_walls(const py::object& points, const py::object& normals,
                             const py::array_t<double, py::array::c_style>& reach,
                             const py::object& vertices, const py::object& triangles,
                             Progress* progress, int threads) {
  const Points rows(points, "points"), directions(normals, "normals"),
      corners(vertices, "vertices");
  const Triangles faces(triangles);
  const Run run{thread_count(thread_argument(threads)), progress};
  std::vector<double> result;
  {
    const auto row_span = rows.span(), direction_span = directions.span();
    const auto corner_span = corners.span();
    const auto face_span = faces.span();
    const std::span<const double> reaches(reach.data(), static_cast<size_t>(reach.size()));
    const py::gil_scoped_release release;
    result = wall_distances(row_span, direction_span, reaches, corner_span, face_span, run);
  }
  return array_of<double>(std::move(result));
}

}  // namespace

void bind_stages(py::module_& m) {
  m.def("delaunay", &delaunay, kDelaunayDoc, py::arg("points"));
  m.def("poles", &pole_vectors, kPolesDoc, py::arg("points"));
  m.def("umbrellas", &umbrella_triangles, kUmbrellasDoc, py::arg("points"));
  m.def("power_shape", &shape_of_balls, kPowerShapeDoc, py::arg("centres"), py::arg("radii"),
        py::arg("wanted"), py::kw_only(), py::arg("progress") = nullptr);
  m.def("cocone", &cocone_parts, kCoconeDoc, py::arg("points"), py::arg("options") = py::none());
  m.def("open_edges", &count_open_edges, kOpenEdgesDoc, py::arg("points"), py::arg("triangles"));
  m.def("solid_betti", &betti_of_solid, kSolidBettiDoc, py::arg("points"), py::arg("triangles"));
  m.def("polygon_edges", &edges_of_polygons, kPolygonEdgesDoc, py::arg("face_offsets"),
        py::arg("face_vertices"), py::arg("vertices"));
  m.def("polygon_triangles", &triangles_of_polygons, kPolygonTrianglesDoc, py::arg("points"),
        py::arg("face_offsets"), py::arg("face_vertices"));
  m.def("winding_number", &winding_numbers, kWindingDoc, py::arg("queries"), py::arg("vertices"),
        py::arg("triangles"));
  m.def("surface_distances", &surface_distances, kSurfaceDistanceDoc, py::arg("queries"),
        py::arg("vertices"), py::arg("triangles"), py::kw_only(), py::arg("progress") = nullptr,
        py::arg("threads") = 0);
  m.def("buried", &buried_points, kBuriedDoc, py::arg("points"), py::arg("normals"),
        py::arg("offset"), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("wall_distances", &distances_of_walls, kWallsDoc, py::arg("points"), py::arg("normals"),
        py::arg("reach"), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
}

}  // namespace medial::python
