// SPDX-License-Identifier: GPL-3.0-or-later
// This binds CoconeOptions and TightCocone for Python.
#include "arrays.h"
#include "bindings.h"
#include "cocone/watertight_surface.h"
#include "docstrings.h"

namespace medial::python {
namespace {

using Surface = WatertightSurface;

std::shared_ptr<Surface> reconstruct(const py::object& points, const CoconeOptions* options,
                                     Progress* progress, int threads) {
  const Points rows(points, "points");
  const CoconeOptions chosen = options ? *options : CoconeOptions{};
  const int team = thread_argument(threads);
  const py::gil_scoped_release release;
  return std::make_shared<Surface>(watertight_surface(rows.span(), chosen, team, progress));
}

CoconeOptions options(double cocone_angle, double flatness_ratio, double flatness_angle,
                      double sharp_angle) {
  const CoconeOptions result{cocone_angle, flatness_ratio, flatness_angle, sharp_angle};
  require_valid(result);
  return result;
}

void bind_options(py::module_& m) {
  const CoconeOptions paper;
  py::class_<CoconeOptions>(m, "CoconeOptions", docs::CoconeOptions, py::is_final(),
                            py::module_local())
      .def(py::init(&options), py::kw_only(), py::arg("cocone_angle") = paper.cocone_angle,
           py::arg("flatness_ratio") = paper.flatness_ratio,
           py::arg("flatness_angle") = paper.flatness_angle,
           py::arg("sharp_angle") = paper.sharp_angle)
      .def_readonly("cocone_angle", &CoconeOptions::cocone_angle, docs::CoconeOptions_cocone_angle)
      .def_readonly("flatness_ratio", &CoconeOptions::flatness_ratio,
                    docs::CoconeOptions_flatness_ratio)
      .def_readonly("flatness_angle", &CoconeOptions::flatness_angle,
                    docs::CoconeOptions_flatness_angle)
      .def_readonly("sharp_angle", &CoconeOptions::sharp_angle, docs::CoconeOptions_sharp_angle);
}

}  // namespace

void bind_tight_cocone(py::module_& m) {
  bind_options(m);
  py::class_<Surface, std::shared_ptr<Surface>> c(m, "TightCocone", docs::TightCocone,
                                                  py::is_final(), py::module_local());
  add_view(c, "triangles", &Surface::triangles, docs::TightCocone_triangles);
  add_view(c, "samples", &Surface::samples, docs::TightCocone_samples);
  add_view<bool>(c, "flat", &Surface::flat, docs::TightCocone_flat);
  add_view<bool>(c, "good", &Surface::good, docs::TightCocone_good);
  add_view<bool>(c, "on_surface", &Surface::on_surface, docs::TightCocone_on_surface);
  c.def(py::init(&reconstruct), py::arg("points"), py::kw_only(), py::arg("options") = py::none(),
        py::arg("progress") = nullptr, py::arg("threads") = 0)
      .def_property_readonly(
          "cell_side", [](const Surface& s) { return numbers_of(s.sides); },
          docs::TightCocone_cell_side)
      .def_readonly("nonmanifold_edges", &Surface::nonmanifold_edges,
                    docs::TightCocone_nonmanifold_edges)
      .def_readonly("nonmanifold_vertices", &Surface::nonmanifold_vertices,
                    docs::TightCocone_nonmanifold_vertices)
      .def_readonly("cavities", &Surface::cavities, docs::TightCocone_cavities)
      .def_readonly("inner_cells", &Surface::inner_cells, docs::TightCocone_inner_cells)
      .def_readonly("left_outside", &Surface::left_outside, docs::TightCocone_left_outside)
      .def_property_readonly("encloses", &Surface::encloses, docs::TightCocone_encloses)
      .def_readonly("duplicates", &Surface::duplicates, docs::TightCocone_duplicates)
      .def_property_readonly(
          "timings", [](const Surface& s) { return seconds(s.timings); },
          docs::TightCocone_timings);
}

}  // namespace medial::python
