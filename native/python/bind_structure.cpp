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
  using Rows = py::array_t<int32_t, py::array::c_style>;
  if (!py::isinstance<Rows>(pairs) || py::cast<Rows>(pairs).ndim() != 2 ||
      py::cast<Rows>(pairs).shape(1) != 2) {
    throw InvalidInputError("Expected " + std::string(name) +
                            " as a contiguous (n, 2) int32 array, found " + describe(pairs) +
                            "; convert it.");
  }
  const auto view = py::reinterpret_borrow<Rows>(pairs);
  return {reinterpret_cast<const Edge*>(view.data()), static_cast<size_t>(view.shape(0))};
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
  const auto vertex_span = rows.span();
  const auto face_span = faces.span();
  const int team = thread_argument(threads);
  SurfacePatches found;
  {
    const py::gil_scoped_release release;
    found = surface_patches(vertex_span, face_span, points ? &places : nullptr, sharp_angle, marked,
                            team);
  }
  return py::make_tuple(array_of<int32_t>(std::move(found.of_triangle)),
                        array_of<int32_t>(std::move(found.of_sample)));
}

// Makes a property of a column of enums, as numbers.
template <typename Values>
auto number_property(Values Structure::*member) {
  return [member](const Structure& s) { return numbers_of(s.*member); };
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
  py::class_<S>(m, "Structure", docs::Structure, py::is_final(), py::module_local())
      .def_property_readonly("part", view_property<int32_t>(&S::part), docs::Structure_part)
      .def_property_readonly(
          "turned",
          [](const py::object& self) {
            return view_of<uint8_t>(self.cast<const S&>().turned, self).attr("view")("bool");
          },
          docs::Structure_turned)
      .def_property_readonly("edges", view_property<int32_t>(&S::edges), docs::Structure_edges)
      .def_property_readonly("seam", number_property(&S::seam), docs::Structure_seam)
      .def_property_readonly("curve", view_property<int32_t>(&S::curve), docs::Structure_curve)
      .def_property_readonly("kind", number_property(&S::kind), docs::Structure_kind)
      .def_property_readonly("part_patches", view_property<int32_t>(&S::part_patches),
                             docs::Structure_part_patches)
      .def_property_readonly("part_area", view_property<double>(&S::part_area),
                             docs::Structure_part_area)
      .def_property_readonly("part_mean_radius", view_property<double>(&S::part_mean_radius),
                             docs::Structure_part_mean_radius)
      .def_property_readonly("part_least_radius", view_property<double>(&S::part_least_radius),
                             docs::Structure_part_least_radius)
      .def_property_readonly("curve_kind", number_property(&S::curve_kind),
                             docs::Structure_curve_kind)
      .def_property_readonly("curve_length", view_property<double>(&S::curve_length),
                             docs::Structure_curve_length)
      .def_property_readonly("curve_mean_radius", view_property<double>(&S::curve_mean_radius),
                             docs::Structure_curve_mean_radius)
      .def_property_readonly("curve_least_radius", view_property<double>(&S::curve_least_radius),
                             docs::Structure_curve_least_radius)
      .def_property_readonly("curve_part_offsets", view_property<int32_t>(&S::curve_part_offsets),
                             docs::Structure_curve_part_offsets)
      .def_property_readonly("curve_parts", view_property<int32_t>(&S::curve_parts),
                             docs::Structure_curve_parts)
      .def_property_readonly("node_kind", number_property(&S::node_kind), docs::Structure_node_kind)
      .def_property_readonly("node_vertex", view_property<int32_t>(&S::node_vertex),
                             docs::Structure_node_vertex)
      .def_property_readonly("node_curve_offsets", view_property<int32_t>(&S::node_curve_offsets),
                             docs::Structure_node_curve_offsets)
      .def_property_readonly("node_curves", view_property<int32_t>(&S::node_curves),
                             docs::Structure_node_curves);
  m.def("structure", &structure, docs::structure, py::kw_only(), py::arg("vertices"),
        py::arg("radius"), py::arg("face_offsets"), py::arg("face_vertices"), py::arg("generators"),
        py::arg("wires"), py::arg("patches"), py::arg("spacing"), py::arg("threads") = 0);
  m.def("surface_patches", &patches_of_surface, docs::surface_patches, py::arg("vertices"),
        py::arg("triangles"), py::kw_only(), py::arg("samples") = py::none(),
        py::arg("sharp_angle") = SamplingOptions{}.sharp_angle, py::arg("sharp_edges") = py::none(),
        py::arg("threads") = 0);
}

}  // namespace medial::python
