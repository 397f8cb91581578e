// SPDX-License-Identifier: GPL-3.0-or-later
// This binds queries about triangulated surfaces and polygons that need no analysis.
#include <memory>

#include "arrays.h"
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
#include "sampling/closest_on_flat.h"

namespace medial::python {
namespace {

Run all_cores() { return {thread_count(0), nullptr}; }

int64_t count_open_edges(const py::object& points, const py::object& triangles) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  const py::gil_scoped_release release;
  return open_edges(rows.span(), faces.span(), all_cores());
}

py::object betti_of_solid(const py::object& points, const py::object& triangles) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  const auto betti = released([&] {
    require_corners(faces.span(), rows.span().size());
    const Samples samples = distinct_rows(rows.span(), "point", all_cores());
    const medial::Surface surface =
        make_surface(faces.span(), samples.point_of_row, samples.count(), all_cores());
    return solid_betti(surface, samples.points, all_cores());
  });
  if (!betti) return py::none();
  return py::make_tuple((*betti)[0], (*betti)[1], (*betti)[2]);
}

py::tuple faces_of_solid(const py::object& points, const py::object& triangles, Progress* progress,
                         int threads) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  const Run run{thread_count(thread_argument(threads)), progress};
  auto found = released([&] { return outward_faces(rows.span(), faces.span(), run); });
  return py::make_tuple(array_of(std::move(found.triangles)), array_of(std::move(found.reading)),
                        found.patches, found.unseen);
}

py::tuple wrapped_faces(const py::object& points, const py::object& triangles, double opening,
                        double distance, Progress* progress) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  auto found = released([&] {
    return wrap(rows.span(), faces.span(), opening, distance, {1, progress});
  });
  return arrays_of(std::move(found.rows), std::move(found.triangles));
}

py::object even_triangles(const py::object& points, const py::object& triangles, double length,
                          Progress* progress) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  if (!(length > 0)) {
    throw InvalidInputError("Expected a positive length of edges, found " + std::to_string(length) +
                            "; choose a larger one");
  }
  auto found = released([&] {
    require_corners(faces.span(), rows.span().size());
    return even_sheet(rows.span(), faces.span(), length, {1, progress});
  });
  if (!found) return py::none();
  return arrays_of(std::move(found->rows), std::move(found->given), std::move(found->triangles));
}

py::tuple parts_of_mesh(const py::object& points, const py::object& triangles) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  auto found = released([&] { return mesh_parts(rows.span(), faces.span(), all_cores()); });
  return py::make_tuple(array_of(std::move(found.part)), array_of<bool>(std::move(found.open)),
                        array_of<bool>(std::move(found.flat)));
}

py::tuple places_of_parts(const py::object& points, const py::object& triangles) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  auto [parts, places] = released([&] {
    MeshParts found = mesh_parts(rows.span(), faces.span(), all_cores());
    auto kinds = part_places(rows.span(), faces.span(), found, all_cores());
    return std::pair(std::move(found), std::move(kinds));
  });
  return py::make_tuple(array_of(std::move(parts.part)), array_of<bool>(std::move(parts.open)),
                        array_of(std::move(places)));
}

py::tuple edges_of_polygons(const py::object& face_offsets, const py::object& face_vertices,
                            int32_t vertices) {
  const auto offsets = ids_of(face_offsets, "face_offsets");
  const auto corners = ids_of(face_vertices, "face_vertices");
  auto edges = released([&] { return polygon_edges(offsets, corners, vertices, all_cores()); });
  return arrays_of(std::move(edges.ends), std::move(edges.of_corner));
}

py::array areas_of_polygons(const py::object& points, const py::object& face_offsets,
                            const py::object& face_vertices) {
  const Points rows(points, "points");
  const auto offsets = ids_of(face_offsets, "face_offsets");
  const auto corners = ids_of(face_vertices, "face_vertices");
  return array_of(
      released([&] { return doubled_areas(rows.span(), offsets, corners, all_cores()); }));
}

py::array triangles_of_polygons(const py::object& points, const py::object& face_offsets,
                                const py::object& face_vertices) {
  const Points rows(points, "points");
  const auto offsets = ids_of(face_offsets, "face_offsets");
  const auto corners = ids_of(face_vertices, "face_vertices");
  return array_of(
      released([&] { return polygon_triangles(rows.span(), offsets, corners, all_cores()); }));
}

py::array faces_that_cross(const py::object& points, const py::object& triangles, int64_t most) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  return array_of(released([&] { return crossing_faces(rows.span(), faces.span(), most); }));
}

py::array winding_numbers(const py::object& queries, const py::object& vertices,
                          const py::object& triangles) {
  const Points query_rows(queries, "queries"), vertex_rows(vertices, "vertices");
  const Triangles faces(triangles);
  return array_of(released([&] {
    const auto at = query_rows.span(), corners = vertex_rows.span();
    const auto triples = faces.span();
    require_finite(at, "query");
    require_finite(corners, "vertex");
    require_corners(triples, corners.size());
    const auto fans = rows_containing(triples, static_cast<int32_t>(corners.size()));
    const auto boundary = boundary_edges(triples, fans, all_cores());
    const WindingNumber winding(corners, triples, boundary, nullptr);
    std::vector<double> result(at.size());
    parallel_for(static_cast<int64_t>(at.size()), all_cores(),
                 [&](int64_t i) { result[i] = winding(at[i]); });
    return result;
  }));
}

py::array buried_points(const py::object& points, const py::object& normals, double offset,
                        const py::object& vertices, const py::object& triangles, Progress* progress,
                        int threads) {
  const Points rows(points, "points"), directions(normals, "normals"),
      corners(vertices, "vertices");
  const Triangles faces(triangles);
  const Run run{thread_count(thread_argument(threads)), progress};
  return array_of<bool>(released([&] {
    return buried(rows.span(), directions.span(), offset, corners.span(), faces.span(), run);
  }));
}

// Checks a surface of which something is asked.
void require_surface(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  require_finite(vertices, "vertices");
  require_corners(triangles, vertices.size());
  if (triangles.empty()) {
    throw InvalidInputError("Expected at least one triangle, found none; pass a surface.");
  }
}

std::unique_ptr<TriangleTree> tree_of(const py::object& vertices, const py::object& triangles) {
  const Points corners(vertices, "vertices");
  const Triangles faces(triangles);
  return released([&] {
    require_surface(corners.span(), faces.span());
    return std::make_unique<TriangleTree>(corners.span(), faces.span());
  });
}

py::array surface_distances(const TriangleTree& tree, const py::object& queries, Progress* progress,
                            int threads) {
  const Points asked(queries, "queries");
  const Run run{thread_count(thread_argument(threads)), progress};
  const auto at = asked.span();
  return array_of(released([&] {
    require_finite(at, "queries");
    std::vector<double> result(at.size());
    parallel_for(static_cast<int64_t>(at.size()), run,
                 [&](int64_t i) { result[i] = tree.distance(at[i]); });
    return result;
  }));
}

py::tuple places_on_surface(const py::object& queries, const py::object& vertices,
                            const py::object& triangles) {
  const Points asked(queries, "queries"), corners(vertices, "vertices");
  const Triangles faces(triangles);
  const auto at = asked.span(), rows = corners.span();
  const auto face_span = faces.span();
  require_finite(at, "queries");
  require_surface(rows, face_span);
  std::vector<int32_t> nearest(at.size());
  std::vector<Vec3> weights(at.size());
  released([&] {
    const TriangleTree tree(rows, face_span);
    parallel_for(static_cast<int64_t>(at.size()), all_cores(), [&](int64_t i) {
      nearest[i] = tree.nearest(at[i]);
      const auto& [a, b, c] = face_span[nearest[i]];
      const Barycentric place = closest_on_flat(rows[a], rows[b], rows[c], at[i]);
      weights[i] = {place.a, place.b, place.c};
    });
  });
  return arrays_of(std::move(nearest), std::move(weights));
}

py::array distances_of_walls(const py::object& points, const py::object& normals,
                             const py::array_t<double, py::array::c_style>& reach,
                             const py::object& vertices, const py::object& triangles,
                             Progress* progress, int threads) {
  const Points rows(points, "points"), directions(normals, "normals"),
      corners(vertices, "vertices");
  const Triangles faces(triangles);
  const Run run{thread_count(thread_argument(threads)), progress};
  const std::span<const double> reaches(reach.data(), static_cast<size_t>(reach.size()));
  return array_of(released([&] {
    return wall_distances(rows.span(), directions.span(), reaches, corners.span(), faces.span(),
                          run);
  }));
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
  py::class_<TriangleTree>(m, "TriangleTree", docs::TriangleTree, py::is_final(),
                           py::module_local())
      .def(py::init(&tree_of), py::arg("vertices"), py::arg("triangles"))
      .def("distances", &surface_distances, docs::TriangleTree_distances, py::arg("queries"),
           py::kw_only(), py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("surface_places", &places_on_surface, docs::surface_places, py::arg("queries"),
        py::arg("vertices"), py::arg("triangles"));
  m.def("buried", &buried_points, docs::buried, py::arg("points"), py::arg("normals"),
        py::arg("offset"), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("wall_distances", &distances_of_walls, docs::wall_distances, py::arg("points"),
        py::arg("normals"), py::arg("reach"), py::arg("vertices"), py::arg("triangles"),
        py::kw_only(), py::arg("progress") = nullptr, py::arg("threads") = 0);
}

}  // namespace medial::python
