// SPDX-License-Identifier: GPL-3.0-or-later
// This binds queries about triangulated surfaces and polygons that need no analysis.
#include "arrays.h"
#include "base/polygon_areas.h"
#include "base/polygon_edges.h"
#include "base/rounding.h"
#include "base/rows.h"
#include "base/triangle_tree.h"
#include "bindings.h"
#include "delaunay/samples.h"
#include "docstrings.h"
#include "inside/buried.h"
#include "inside/mesh_parts.h"
#include "inside/outward_faces.h"
#include "inside/part_places.h"
#include "inside/solid_betti.h"
#include "inside/surface.h"
#include "inside/walls.h"
#include "inside/winding_number.h"
#include "mesh/crossing_faces.h"
#include "mesh/even_sheet.h"
#include "mesh/polygon_triangles.h"
#include "mesh/wrap.h"

namespace medial::python {
namespace {

Run all_cores() { return {thread_count(0), nullptr}; }

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

py::tuple faces_of_solid(const py::object& points, const py::object& triangles, Progress* progress,
                         int threads) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  const Run run{thread_count(thread_argument(threads)), progress};
  OutwardFaces found = [&, row_span = rows.span(), face_span = faces.span()] {
    const py::gil_scoped_release release;
    return outward_faces(row_span, face_span, run);
  }();
  std::vector<uint8_t> reading;
  reading.reserve(found.reading.size());
  for (const FaceReading one : found.reading) reading.push_back(static_cast<uint8_t>(one));
  return py::make_tuple(array_of<int32_t>(std::move(found.triangles)),
                        array_of<uint8_t>(std::move(reading)), found.patches, found.unseen);
}

py::tuple wrapped_faces(const py::object& points, const py::object& triangles, double opening,
                        double distance, Progress* progress) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  Wrapping found = [&, row_span = rows.span(), face_span = faces.span()] {
    const py::gil_scoped_release release;
    return wrap(row_span, face_span, opening, distance, {1, progress});
  }();
  return py::make_tuple(array_of<double>(std::move(found.rows)),
                        array_of<int32_t>(std::move(found.triangles)));
}

py::object even_triangles(const py::object& points, const py::object& triangles, double length,
                          Progress* progress) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  if (!(length > 0)) {
    throw InvalidInputError("Expected a positive length of edges, found " + std::to_string(length) +
                            "; choose a larger one");
  }
  std::optional<EvenSheet> found = [&, row_span = rows.span(), face_span = faces.span()] {
    const py::gil_scoped_release release;
    require_corners(face_span, row_span.size());
    return even_sheet(row_span, face_span, length, {1, progress});
  }();
  if (!found) return py::none();
  return py::make_tuple(array_of<double>(std::move(found->rows)),
                        array_of<int32_t>(std::move(found->given)),
                        array_of<int32_t>(std::move(found->triangles)));
}

py::tuple parts_of_mesh(const py::object& points, const py::object& triangles) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  MeshParts found = [&, row_span = rows.span(), face_span = faces.span()] {
    const py::gil_scoped_release release;
    return mesh_parts(row_span, face_span, all_cores());
  }();
  return py::make_tuple(array_of<int32_t>(std::move(found.part)),
                        array_of<bool>(std::move(found.open)),
                        array_of<bool>(std::move(found.flat)));
}

py::tuple places_of_parts(const py::object& points, const py::object& triangles) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  auto [parts, places] = [&, row_span = rows.span(), face_span = faces.span()] {
    const py::gil_scoped_release release;
    MeshParts found = mesh_parts(row_span, face_span, all_cores());
    std::vector<uint8_t> kinds;
    for (const PartPlace place : part_places(row_span, face_span, found, all_cores())) {
      kinds.push_back(static_cast<uint8_t>(place));
    }
    return std::pair(std::move(found), std::move(kinds));
  }();
  return py::make_tuple(array_of<int32_t>(std::move(parts.part)),
                        array_of<bool>(std::move(parts.open)),
                        array_of<uint8_t>(std::move(places)));
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

py::array areas_of_polygons(const py::object& points, const py::object& face_offsets,
                            const py::object& face_vertices) {
  const Points rows(points, "points");
  const auto offsets = ids_of(face_offsets, "face_offsets");
  const auto corners = ids_of(face_vertices, "face_vertices");
  auto doubled = [&, span = rows.span()] {
    const py::gil_scoped_release release;
    return doubled_areas(span, offsets, corners, all_cores());
  }();
  return array_of<double>(std::move(doubled));
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

py::array faces_that_cross(const py::object& points, const py::object& triangles, int64_t most) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  auto pairs = [&, row_span = rows.span(), face_span = faces.span()] {
    const py::gil_scoped_release release;
    return crossing_faces(row_span, face_span, most);
  }();
  return array_of<int32_t>(std::move(pairs));
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

void bind_surfaces(py::module_& m) {
  m.def("open_edges", &count_open_edges, docs::open_edges, py::arg("points"), py::arg("triangles"));
  m.def("solid_betti", &betti_of_solid, docs::solid_betti, py::arg("points"), py::arg("triangles"));
  m.def("outward_faces", &faces_of_solid, docs::outward_faces, py::arg("points"),
        py::arg("triangles"), py::kw_only(), py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("even_sheet", &even_triangles, docs::even_sheet, py::arg("points"), py::arg("triangles"),
        py::arg("length"), py::kw_only(), py::arg("progress") = nullptr);
  m.def("wrap", &wrapped_faces, docs::wrap, py::arg("points"), py::arg("triangles"),
        py::arg("opening"), py::arg("distance"), py::kw_only(), py::arg("progress") = nullptr);
  m.def(
      "are_single",
      [](const py::object& points) { return are_single(Points(points, "points").span()); },
      docs::are_single, py::arg("points"));
  m.def(
      "rounding_of",
      [](const py::object& points, double far) {
        return rounding_of(Points(points, "points").span(), far);
      },
      docs::rounding_of, py::arg("points"), py::arg("far") = 0.0);
  m.def("mesh_parts", &parts_of_mesh, docs::mesh_parts, py::arg("points"), py::arg("triangles"));
  m.def("part_places", &places_of_parts, docs::part_places, py::arg("points"),
        py::arg("triangles"));
  m.def("polygon_edges", &edges_of_polygons, docs::polygon_edges, py::arg("face_offsets"),
        py::arg("face_vertices"), py::arg("vertices"));
  m.def("polygon_areas", &areas_of_polygons, docs::polygon_areas, py::arg("points"),
        py::arg("face_offsets"), py::arg("face_vertices"));
  m.def("polygon_triangles", &triangles_of_polygons, docs::polygon_triangles, py::arg("points"),
        py::arg("face_offsets"), py::arg("face_vertices"));
  m.def("crossing_faces", &faces_that_cross, docs::crossing_faces, py::arg("points"),
        py::arg("triangles"), py::kw_only(), py::arg("most") = 20'000'000);
  m.def("winding_number", &winding_numbers, docs::winding_number, py::arg("queries"),
        py::arg("vertices"), py::arg("triangles"));
  m.def("surface_distances", &surface_distances, docs::surface_distances, py::arg("queries"),
        py::arg("vertices"), py::arg("triangles"), py::kw_only(), py::arg("progress") = nullptr,
        py::arg("threads") = 0);
  m.def("buried", &buried_points, docs::buried, py::arg("points"), py::arg("normals"),
        py::arg("offset"), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("wall_distances", &distances_of_walls, docs::wall_distances, py::arg("points"),
        py::arg("normals"), py::arg("reach"), py::arg("vertices"), py::arg("triangles"),
        py::kw_only(), py::arg("progress") = nullptr, py::arg("threads") = 0);
}

}  // namespace medial::python
