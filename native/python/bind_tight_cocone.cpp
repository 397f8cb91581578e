// SPDX-License-Identifier: GPL-3.0-or-later
// CoconeOptions and TightCocone for Python.
#include "arrays.h"
#include "bindings.h"
#include "cocone/watertight_surface.h"

namespace medial::python {
namespace {

constexpr const char* kOptionsDoc =
    "The constants of Cocone and Tight Cocone; all are angles in radians or pure numbers.\n\n"
    "Parameters\n----------\n"
    "cocone_angle : float\n    Half-angle of the cocone about the tangent plane; default pi/8 "
    "(Amenta, Choi, Dey & Leekha 2002).\n"
    "flatness_ratio : float\n    A flat sample's cell is longer towards both poles than this times "
    "its width; default 1.2\n    (Dey & Giesen 2001).\n"
    "flatness_angle : float\n    A flat sample's normal line agrees with its cocone neighbours' "
    "within this; default pi/3\n    (Dey & Giesen 2001).\n"
    "sharp_angle : float\n    An edge is sharp when no two of its triangles continue each other "
    "with normals closer than\n    this; default 2 pi/3 (Dey & Goswami 2003).\n\n"
    "Raises\n------\nInvalidInputError\n    An angle outside (0, pi/2), a sharp_angle outside (0, "
    "pi), or a ratio that is not positive.";

constexpr const char* kTightConeDoc =
    "The watertight surface through the samples: a subcomplex of their Delaunay triangulation (Dey "
    "& Goswami 2003).\n\n"
    "Parameters\n----------\n"
    "points : (n, 3) float64\n    As for `MedialAnalysis`.\n"
    "options : CoconeOptions, optional\n"
    "progress : Progress, optional\n"
    "threads : int\n    0: as many as the machine has. The result does not depend on it.\n\n"
    "Raises\n------\nInvalidInputError, DegenerateInputError, Cancelled";

using Surface = WatertightSurface;

std::shared_ptr<Surface> reconstruct(const py::object& points, const CoconeOptions* options,
                                     Progress* progress, int threads) {
  const Points rows(points, "points");
  const CoconeOptions chosen = options ? *options : CoconeOptions{};
  const int team = thread_argument(threads);
  const auto span = rows.span();
  const py::gil_scoped_release release;
  return std::make_shared<Surface>(watertight_surface(span, chosen, team, progress));
}

CoconeOptions options(double cocone_angle, double flatness_ratio, double flatness_angle,
                      double sharp_angle) {
  const CoconeOptions result{cocone_angle, flatness_ratio, flatness_angle, sharp_angle};
  require_valid(result);
  return result;
}

auto flags(std::vector<uint8_t> Surface::*member) {
  return [member](const py::object& self) {
    return view_of<uint8_t>(self.cast<const Surface&>().*member, self).attr("view")("bool");
  };
}

void bind_options(py::module_& m) {
  const CoconeOptions paper;
  py::class_<CoconeOptions>(m, "CoconeOptions", kOptionsDoc, py::is_final(), py::module_local())
      .def(py::init(&options), py::kw_only(), py::arg("cocone_angle") = paper.cocone_angle,
           py::arg("flatness_ratio") = paper.flatness_ratio,
           py::arg("flatness_angle") = paper.flatness_angle,
           py::arg("sharp_angle") = paper.sharp_angle)
      .def_readonly("cocone_angle", &CoconeOptions::cocone_angle,
                    "Half-angle of the cocone about the tangent plane, radians.")
      .def_readonly("flatness_ratio", &CoconeOptions::flatness_ratio,
                    "A flat sample's cell is longer towards both poles than this times its width.")
      .def_readonly("flatness_angle", &CoconeOptions::flatness_angle,
                    "Largest angle between the normal lines of flat cocone neighbours, radians.")
      .def_readonly(
          "sharp_angle", &CoconeOptions::sharp_angle,
          "Largest angle between the normals of triangles that continue each other, radians.");
}

}  // namespace

void bind_tight_cocone(py::module_& m) {
  bind_options(m);
  py::class_<Surface, std::shared_ptr<Surface>>(m, "TightCocone", kTightConeDoc, py::is_final(),
                                                py::module_local())
      .def(py::init(&reconstruct), py::arg("points"), py::kw_only(),
           py::arg("options") = py::none(), py::arg("progress") = nullptr, py::arg("threads") = 0)
      .def_property_readonly(
          "triangles", view_property<int32_t>(&Surface::triangles),
          "(f, 3) int32: facets between inner and outer cells, outward, lowest row first, in "
          "lexicographic order.")
      .def_property_readonly(
          "cell_side", [](const Surface& s) { return numbers_of(s.sides); },
          "(c,) int32: INNER or OUTER for each cell of `delaunay(points)`, infinite cells "
          "included.")
      .def_property_readonly("samples", view_property<int32_t>(&Surface::samples),
                             "(k,) int32: rows of the distinct points, ascending.")
      .def_property_readonly("flat", flags(&Surface::flat),
                             "(k,) bool: well sampled there: the Voronoi cell is long and thin and "
                             "its neighbours agree.")
      .def_property_readonly("good", flags(&Surface::good),
                             "(k,) bool: the triangles that Cocone finds at the sample are one "
                             "disc round it.")
      .def_property_readonly("on_surface", flags(&Surface::on_surface),
                             "(k,) bool: a corner of one of `triangles`.")
      .def_readonly("nonmanifold_edges", &Surface::nonmanifold_edges,
                    "Edges in more than two of `triangles`.")
      .def_readonly("nonmanifold_vertices", &Surface::nonmanifold_vertices,
                    "Samples round which `triangles` are not one disc, ends of those edges "
                    "included.")
      .def_readonly("cavities", &Surface::cavities,
                    "Patches of good samples inside the solid that flooding from infinity cannot "
                    "reach: closed inner\ncavities, most likely, which are filled.")
      .def_readonly("inner_cells", &Surface::inner_cells,
                    "Delaunay cells inside; 0 when the samples enclose nothing.")
      .def_readonly("left_outside", &Surface::left_outside,
                    "Samples without an inner cell: outliers, or parts that could not be closed.")
      .def_property_readonly("encloses", &Surface::encloses,
                             "At most half of the samples are left outside. Otherwise the solid is "
                             "empty, or pinched to\npieces, and says nothing about the shape.")
      .def_readonly("duplicates", &Surface::duplicates,
                    "Rows merged into an earlier row with the same coordinates.")
      .def_property_readonly(
          "timings", [](const Surface& s) { return seconds(s.timings); },
          "Seconds of each stage, in order; none for that of a `MedialAnalysis`.");
}

}  // namespace medial::python
