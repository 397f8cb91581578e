// SPDX-License-Identifier: GPL-3.0-or-later
// This binds sphere meshes for Python: reduced, measured, and as points on their surface.
#include <medial/sphere_mesh.h>

#include "arrays.h"
#include "bindings.h"
#include "docstrings.h"

namespace medial::python {
namespace {

SphereMesh sphere_mesh(const py::object& vertices, const py::object& radius,
                       const py::object& triangles, const py::object& edges) {
  const Points rows(vertices, "vertices");
  const Triangles faces(triangles);
  const auto places = rows.span();
  const auto corners = faces.span();
  const auto radii = column_of<double>(radius, "radius", "(v,) float64");
  const auto ends = edges_of(edges);
  return {{places.begin(), places.end()},
          {radii.begin(), radii.end()},
          {corners.begin(), corners.end()},
          {ends.begin(), ends.end()}};
}

py::tuple reduced(const py::object& vertices, const py::object& radius, const py::object& triangles,
                  const py::object& edges, int64_t wanted, Progress* progress, int threads) {
  const SphereMesh mesh = sphere_mesh(vertices, radius, triangles, edges);
  const auto most = static_cast<int32_t>(std::clamp<int64_t>(wanted, 0, INT_MAX));
  const ReduceOptions options{most, thread_argument(threads)};
  SphereMesh result = released([&] { return reduce(mesh, options, progress); });
  return arrays_of(std::move(result.vertices), std::move(result.radius),
                   std::move(result.triangles), std::move(result.wires));
}

py::object sheets(const py::object& vertices, const py::object& radius, const py::object& triangles,
                  const py::object& edges, const py::object& part, const py::object& nodes,
                  int64_t wanted, double shortest, Progress* progress, int threads) {
  const SphereMesh mesh = sphere_mesh(vertices, radius, triangles, edges);
  const SheetLabels labels{column_of<int32_t>(part, "part", "(t,) int32"),
                           column_of<int32_t>(nodes, "nodes", "(n,) int32"), shortest};
  const auto most = static_cast<int32_t>(std::clamp<int64_t>(wanted, 0, INT_MAX));
  const ReduceOptions options{most, thread_argument(threads)};
  auto found = released([&] { return reduce_sheets(mesh, labels, options, progress); });
  if (!found) return py::none();
  return arrays_of(std::move(found->vertices), std::move(found->radius), std::move(found->row),
                   std::move(found->face_offsets), std::move(found->face_vertices),
                   std::move(found->part), std::move(found->wires));
}

py::array distances(const py::object& queries, const py::object& vertices, const py::object& radius,
                    const py::object& triangles, const py::object& edges, Progress* progress,
                    int threads) {
  const Points asked(queries, "queries");
  const SphereMesh mesh = sphere_mesh(vertices, radius, triangles, edges);
  const int count = thread_argument(threads);
  return array_of(released([&] { return solid_distances(asked.span(), mesh, count, progress); }));
}

py::array surface(const py::object& vertices, const py::object& radius, const py::object& triangles,
                  const py::object& edges, double spacing, Progress* progress, int threads) {
  const SphereMesh mesh = sphere_mesh(vertices, radius, triangles, edges);
  const int count = thread_argument(threads);
  return array_of(released([&] { return solid_surface(mesh, spacing, count, progress); }));
}

}  // namespace

void bind_reduce(py::module_& m) {
  m.def("reduce_sphere_mesh", &reduced, docs::reduce_sphere_mesh, py::arg("vertices"),
        py::arg("radius"), py::arg("triangles"), py::arg("edges"), py::arg("wanted"), py::kw_only(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("reduce_sheets", &sheets, docs::reduce_sheets, py::arg("vertices"), py::arg("radius"),
        py::arg("triangles"), py::arg("edges"), py::arg("part"), py::arg("nodes"),
        py::arg("wanted"), py::kw_only(), py::arg("shortest") = 0.0, py::arg("progress") = nullptr,
        py::arg("threads") = 0);
  m.def("solid_distances", &distances, docs::solid_distances, py::arg("queries"),
        py::arg("vertices"), py::arg("radius"), py::arg("triangles"), py::arg("edges"),
        py::kw_only(), py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("solid_surface", &surface, docs::solid_surface, py::arg("vertices"), py::arg("radius"),
        py::arg("triangles"), py::arg("edges"), py::arg("spacing"), py::kw_only(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
}

}  // namespace medial::python
