// SPDX-License-Identifier: GPL-3.0-or-later
// This binds the methods of others for Python.
#include "arrays.h"
#include "rivals/power_shape.h"
#include "rivals/rival_axes.h"
#include "study/study_bindings.h"
#include "study_docstrings.h"

namespace medial::python {
namespace {

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

MedialMesh mesh_by_remark(const MedialAnalysis& analysis, Against against, double theta, double rho,
                          Side side, Rule rule, Progress* progress) {
  const py::gil_scoped_release release;
  return axis_by_remark(analysis, against, {{theta, rho, rule}, side}, progress);
}

MedialMesh mesh_by_size(const MedialAnalysis& analysis, SizeCondition condition, double length,
                        double theta, Side side, Progress* progress) {
  const py::gil_scoped_release release;
  return axis_by_size(analysis, {condition, length, theta, side}, progress);
}

py::array ids_by_size(const MedialAnalysis& analysis, SizeCondition condition, double length,
                      double theta, Side side) {
  std::vector<int32_t> ids;
  {
    const py::gil_scoped_release release;
    ids = select_by_size(analysis, {condition, length, theta, side});
  }
  return array_of<int32_t>(std::move(ids));
}

MedialMesh mesh_of_poles(const MedialAnalysis& analysis, Side side, Progress* progress) {
  const py::gil_scoped_release release;
  return pole_axis(analysis, side, progress);
}

void bind_choices(py::module_& m) {
  py::enum_<Against>(m, "Against", py::module_local(), docs::Against)
      .value("UMBRELLA", Against::umbrella, docs::Against_UMBRELLA)
      .value("POLE", Against::pole, docs::Against_POLE)
      .value("POLYGON", Against::polygon, docs::Against_POLYGON)
      .value("POLE_AND_POLYGON", Against::pole_and_polygon, docs::Against_POLE_AND_POLYGON);
  py::enum_<SizeCondition>(m, "SizeCondition", py::module_local(), docs::SizeCondition)
      .value("ANGLE_AND_LENGTH", SizeCondition::angle_and_length,
             docs::SizeCondition_ANGLE_AND_LENGTH)
      .value("LAMBDA", SizeCondition::lambda, docs::SizeCondition_LAMBDA);
}

}  // namespace

void bind_rivals(py::module_& m) {
  bind_choices(m);
  const Thresholds paper;
  const SizeExtraction sizes;
  m.def("power_shape", &shape_of_balls, docs::power_shape, py::arg("centres"), py::arg("radii"),
        py::arg("wanted"), py::kw_only(), py::arg("progress") = nullptr);
  m.def("axis_by_remark", &mesh_by_remark, docs::axis_by_remark, py::arg("analysis"),
        py::arg("against"), py::arg("theta") = paper.theta, py::arg("rho") = paper.rho,
        py::arg("side") = Side::both, py::arg("rule") = paper.rule, py::kw_only(),
        py::arg("progress") = nullptr);
  m.def("axis_by_size", &mesh_by_size, docs::axis_by_size, py::arg("analysis"),
        py::arg("condition"), py::arg("length") = sizes.length, py::arg("theta") = sizes.theta,
        py::arg("side") = Side::both, py::kw_only(), py::arg("progress") = nullptr);
  m.def("select_by_size", &ids_by_size, docs::select_by_size, py::arg("analysis"),
        py::arg("condition"), py::arg("length") = sizes.length, py::arg("theta") = sizes.theta,
        py::arg("side") = Side::both);
  m.def("pole_axis", &mesh_of_poles, docs::pole_axis, py::arg("analysis"),
        py::arg("side") = Side::both, py::kw_only(), py::arg("progress") = nullptr);
}

}  // namespace medial::python
