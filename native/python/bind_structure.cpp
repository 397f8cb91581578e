// SPDX-License-Identifier: GPL-3.0-or-later
// This binds the structure of an axis, and the patches of a surface that it is made of.
#include <medial/sampling.h>
#include <medial/structure.h>

#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "docstrings.h"

namespace medial::python {
namespace {

std::span<const Edge> pairs_of(const py::object& pairs, const char* name) {
  return edges_of(pairs, name, "(n, 2)");
}

Structure structure(const py::object& vertices, const py::object& radius,
                    const py::object& face_offsets, const py::object& face_vertices,
                    const py::object& generators, const py::object& wires,
                    const py::object& patches, const py::object& spacing, int threads) {
  const Points places(vertices, "vertices");
  const StructureInput input{places.span(),
                             column_of<double>(radius, "radius", "(v,) float64"),
                             ids_of(face_offsets, "face_offsets"),
                             ids_of(face_vertices, "face_vertices"),
                             pairs_of(generators, "generators"),
                             pairs_of(wires, "wires"),
                             pairs_of(patches, "patches"),
                             column_of<double>(spacing, "spacing", "(n,) float64")};
  const int team = thread_argument(threads);
  const py::gil_scoped_release release;
  return structure_of(input, team);
}

// Returns the kinds of samples, given as numbers.
std::vector<SampleKind> kinds_of(const py::object& kinds) {
  std::vector<SampleKind> result;
  for (const int32_t kind : ids_of(kinds, "kinds")) {
    if (kind < 0 || kind > static_cast<int32_t>(SampleKind::opening)) {
      throw InvalidInputError("Expected kinds of samples from 0 to 5, found " +
                              std::to_string(kind) + "; pass those of sample_surface.");
    }
    result.push_back(static_cast<SampleKind>(kind));
  }
  return result;
}

py::tuple patches_of_surface(const py::object& vertices, const py::object& triangles,
                             const py::object& samples, double sharp_angle,
                             const py::object& sharp_edges, int threads) {
  const Points rows(vertices, "vertices");
  const Triangles faces(triangles);
  const auto marked =
      sharp_edges.is_none() ? std::span<const Edge>{} : pairs_of(sharp_edges, "sharp_edges");
  std::optional<Points> points;
  std::vector<SampleKind> kinds;
  SamplePlaces places;
  if (!samples.is_none()) {
    if (!py::isinstance<py::tuple>(samples) || py::len(samples) != 3) {
      throw InvalidInputError("Expected samples as points, kinds and triangles, found " +
                              describe(samples) + "; give all three.");
    }
    const py::object at = samples[py::int_(0)], kind = samples[py::int_(1)];
    const py::object triangle = samples[py::int_(2)];
    points.emplace(at, "points");
    kinds = kinds_of(kind);
    places = {points->span(), kinds, ids_of(triangle, "triangle")};
  }
  const int team = thread_argument(threads);
  SurfacePatches found = released([&] {
    return surface_patches(rows.span(), faces.span(), points ? &places : nullptr, sharp_angle,
                           marked, team);
  });
  return arrays_of(std::move(found.of_triangle), std::move(found.of_sample));
}

void bind_kinds(py::module_& m) {
  py::enum_<CurveKind>(m, "CurveKind", py::module_local(), docs::CurveKind)
      .value("NONE", CurveKind::none, docs::CurveKind_NONE)
      .value("SEAM", CurveKind::seam, docs::CurveKind_SEAM)
      .value("RIM", CurveKind::rim, docs::CurveKind_RIM)
      .value("CREASE", CurveKind::crease, docs::CurveKind_CREASE);
  py::enum_<PlaceKind>(m, "PlaceKind", py::module_local(), docs::PlaceKind)
      .value("SHEET", PlaceKind::sheet, docs::PlaceKind_SHEET)
      .value("SEAM", PlaceKind::seam, docs::PlaceKind_SEAM)
      .value("JUNCTION", PlaceKind::junction, docs::PlaceKind_JUNCTION)
      .value("RIM", PlaceKind::rim, docs::PlaceKind_RIM)
      .value("CORNER", PlaceKind::corner, docs::PlaceKind_CORNER)
      .value("WIRE", PlaceKind::wire, docs::PlaceKind_WIRE);
}

}  // namespace

void bind_structure(py::module_& m) {
  bind_kinds(m);
  using S = Structure;
  py::class_<S> c(m, "Structure", docs::Structure, py::is_final(), py::module_local());
  add_view(c, "part", &S::part, docs::Structure_part);
  add_view<bool>(c, "turned", &S::turned, docs::Structure_turned);
  add_view(c, "edges", &S::edges, docs::Structure_edges);
  add_view(c, "seam", &S::seam, docs::Structure_seam);
  add_view(c, "curve", &S::curve, docs::Structure_curve);
  add_view(c, "kind", &S::kind, docs::Structure_kind);
  add_view(c, "part_patches", &S::part_patches, docs::Structure_part_patches);
  add_view(c, "part_area", &S::part_area, docs::Structure_part_area);
  add_view(c, "part_mean_radius", &S::part_mean_radius, docs::Structure_part_mean_radius);
  add_view(c, "part_least_radius", &S::part_least_radius, docs::Structure_part_least_radius);
  add_view(c, "curve_kind", &S::curve_kind, docs::Structure_curve_kind);
  add_view(c, "curve_length", &S::curve_length, docs::Structure_curve_length);
  add_view(c, "curve_mean_radius", &S::curve_mean_radius, docs::Structure_curve_mean_radius);
  add_view(c, "curve_least_radius", &S::curve_least_radius, docs::Structure_curve_least_radius);
  add_view(c, "curve_part_offsets", &S::curve_part_offsets, docs::Structure_curve_part_offsets);
  add_view(c, "curve_parts", &S::curve_parts, docs::Structure_curve_parts);
  add_view(c, "node_kind", &S::node_kind, docs::Structure_node_kind);
  add_view(c, "node_vertex", &S::node_vertex, docs::Structure_node_vertex);
  add_view(c, "node_curve_offsets", &S::node_curve_offsets, docs::Structure_node_curve_offsets);
  add_view(c, "node_curves", &S::node_curves, docs::Structure_node_curves);
  m.def("structure", &structure, docs::structure, py::kw_only(), py::arg("vertices"),
        py::arg("radius"), py::arg("face_offsets"), py::arg("face_vertices"), py::arg("generators"),
        py::arg("wires"), py::arg("patches"), py::arg("spacing"), py::arg("threads") = 0);
  m.def("surface_patches", &patches_of_surface, docs::surface_patches, py::arg("vertices"),
        py::arg("triangles"), py::kw_only(), py::arg("samples") = py::none(),
        py::arg("sharp_angle") = SamplingOptions{}.sharp_angle, py::arg("sharp_edges") = py::none(),
        py::arg("threads") = 0);
}

}  // namespace medial::python
