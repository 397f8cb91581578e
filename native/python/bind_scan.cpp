// SPDX-License-Identifier: GPL-3.0-or-later
// This binds measure_scan and prepare_scan for Python.
#include <medial/scan.h>

#include "arrays.h"
#include "bindings.h"
#include "docstrings.h"

namespace medial::python {
namespace {

ScanMeasure measure(const py::object& points, Progress* progress, int threads) {
  const Points rows(points, "points");
  const int wanted = thread_argument(threads);
  const py::gil_scoped_release release;
  return measure_scan(rows.span(), wanted, progress);
}

PreparedScan prepare(const py::object& points, const ScanMeasure& measured, bool move,
                     Progress* progress, int threads) {
  const Points rows(points, "points");
  const int wanted = thread_argument(threads);
  const py::gil_scoped_release release;
  return prepare_scan(rows.span(), measured, move, wanted, progress);
}

}  // namespace

void bind_scan(py::module_& m) {
  py::class_<ScanMeasure>(m, "ScanMeasure", docs::ScanMeasure, py::is_final(), py::module_local())
      .def_readonly("spacing", &ScanMeasure::spacing, docs::ScanMeasure_spacing)
      .def_readonly("noise", &ScanMeasure::noise, docs::ScanMeasure_noise)
      .def_readonly("kurtosis", &ScanMeasure::kurtosis, docs::ScanMeasure_kurtosis)
      .def_readonly("duplicates", &ScanMeasure::duplicates, docs::ScanMeasure_duplicates)
      .def_property_readonly("outliers", view_property<int32_t>(&ScanMeasure::outliers),
                             docs::ScanMeasure_outliers)
      .def_readonly("border", &ScanMeasure::border, docs::ScanMeasure_border);
  py::class_<PreparedScan>(m, "PreparedScan", docs::PreparedScan, py::is_final(),
                           py::module_local())
      .def_property_readonly("rows", view_property<int32_t>(&PreparedScan::rows),
                             docs::PreparedScan_rows)
      .def_property_readonly("points", view_property<double>(&PreparedScan::points),
                             docs::PreparedScan_points)
      .def_property_readonly("moved", view_property<double>(&PreparedScan::moved),
                             docs::PreparedScan_moved);
  m.def("measure_scan", &measure, docs::measure_scan, py::arg("points"), py::kw_only(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("prepare_scan", &prepare, docs::prepare_scan, py::arg("points"), py::arg("measure"),
        py::kw_only(), py::arg("move") = true, py::arg("progress") = nullptr,
        py::arg("threads") = 0);
}

}  // namespace medial::python
