// SPDX-License-Identifier: GPL-3.0-or-later
// This binds the measures of scans and of noisy faces, and what moves their points, for Python.
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

SurfaceNoise noise(const py::object& points, const py::object& normals, Progress* progress,
                   int threads) {
  const Points rows(points, "points"), directions(normals, "normals");
  const int wanted = thread_argument(threads);
  const py::gil_scoped_release release;
  return surface_noise(rows.span(), directions.span(), wanted, progress);
}

py::array smooth(const py::object& points, const py::object& normals, const SurfaceNoise& measured,
                 Progress* progress, int threads) {
  const Points rows(points, "points"), directions(normals, "normals");
  const int wanted = thread_argument(threads);
  return array_of(released(
      [&] { return smooth_vertices(rows.span(), directions.span(), measured, wanted, progress); }));
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
  py::class_<ScanMeasure> c(m, "ScanMeasure", docs::ScanMeasure, py::is_final(),
                            py::module_local());
  add_view(c, "outliers", &ScanMeasure::outliers, docs::ScanMeasure_outliers);
  c.def_readonly("spacing", &ScanMeasure::spacing, docs::ScanMeasure_spacing)
      .def_readonly("noise", &ScanMeasure::noise, docs::ScanMeasure_noise)
      .def_readonly("kurtosis", &ScanMeasure::kurtosis, docs::ScanMeasure_kurtosis)
      .def_readonly("mates", &ScanMeasure::mates, docs::ScanMeasure_mates)
      .def_readonly("duplicates", &ScanMeasure::duplicates, docs::ScanMeasure_duplicates)
      .def_readonly("border", &ScanMeasure::border, docs::ScanMeasure_border);
  py::class_<PreparedScan> prepared(m, "PreparedScan", docs::PreparedScan, py::is_final(),
                                    py::module_local());
  add_view(prepared, "rows", &PreparedScan::rows, docs::PreparedScan_rows);
  add_view(prepared, "points", &PreparedScan::points, docs::PreparedScan_points);
  add_view(prepared, "moved", &PreparedScan::moved, docs::PreparedScan_moved);
  m.def("measure_scan", &measure, docs::measure_scan, py::arg("points"), py::kw_only(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
  py::class_<SurfaceNoise>(m, "SurfaceNoise", docs::SurfaceNoise, py::is_final(),
                           py::module_local())
      .def_readonly("spacing", &SurfaceNoise::spacing, docs::SurfaceNoise_spacing)
      .def_readonly("noise", &SurfaceNoise::noise, docs::SurfaceNoise_noise)
      .def_readonly("radius", &SurfaceNoise::radius, docs::SurfaceNoise_radius);
  m.def("smooth_vertices", &smooth, docs::smooth_vertices, py::arg("points"), py::arg("normals"),
        py::arg("measure"), py::kw_only(), py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("surface_noise", &noise, docs::surface_noise, py::arg("points"), py::arg("normals"),
        py::kw_only(), py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("prepare_scan", &prepare, docs::prepare_scan, py::arg("points"), py::arg("measure"),
        py::kw_only(), py::arg("move") = true, py::arg("progress") = nullptr,
        py::arg("threads") = 0);
}

}  // namespace medial::python
