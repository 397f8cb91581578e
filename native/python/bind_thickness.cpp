// SPDX-License-Identifier: GPL-3.0-or-later
// Thickness for Python: its modes, what is found, and the patches of what is thin.
#include <medial/thickness.h>

#include "arrays.h"
#include "base/patches.h"
#include "base/rows.h"
#include "bindings.h"
#include "inside/surface.h"

namespace medial::python {
namespace {

constexpr const char* kPatchesDoc =
    "(m,) int32: number of the patch of each triangle: those of `wanted` that share a corner are "
    "in one. Patches are\nnumbered in the order of their first triangles; -1: not wanted.\n\n"
    "Parameters\n----------\n"
    "triangles : (m, 3) int32\n"
    "wanted : (m,) bool\n"
    "vertices : int\n    The number of rows that the triangles count.\n\n"
    "Raises\n------\nInvalidInputError";

py::array patches_of(const py::object& triangles, const py::object& wanted, int64_t vertices) {
  const Triangles faces(triangles);
  const auto flags = flags_of(wanted, "wanted");
  const auto rows = faces.span();
  if (flags.size() != rows.size()) {
    throw InvalidInputError("Expected one flag per triangle, found " +
                            std::to_string(flags.size()) + " for " + std::to_string(rows.size()) +
                            " triangles; pass all of them.");
  }
  require_corners(rows, static_cast<size_t>(std::max<int64_t>(vertices, 0)));
  std::vector<int32_t> result;
  {
    const py::gil_scoped_release release;
    result = patches(rows, flags, static_cast<size_t>(vertices));
  }
  return array_of<int32_t>(std::move(result));
}

}  // namespace

void bind_thickness(py::module_& m) {
  py::enum_<ThicknessMode>(m, "ThicknessMode", py::module_local(),
                           "What `MedialAnalysis.thickness` measures.")
      .value("WALL", ThicknessMode::wall,
             "Balls between walls: where their two normals differ by 120 degrees or more.")
      .value("BALL", ThicknessMode::ball, "All balls; zero at every convex edge.")
      .value("SCAN", ThicknessMode::scan,
             "The ball that comes nearest, for noise; no normals are used.");
  py::class_<WallThickness>(m, "WallThickness",
                            "How thick a solid is at its samples, or how wide the gap; made by "
                            "`MedialAnalysis.thickness`.",
                            py::is_final(), py::module_local())
      .def_property_readonly("values", view_property<double>(&WallThickness::values),
                             "(k,) float64: at each of `MedialAnalysis.samples`, in the unit of "
                             "the input; infinite where there is\nno wall, or no ball.")
      .def_property_readonly(
          "measured",
          [](const py::object& self) {
            return view_of<uint8_t>(self.cast<const WallThickness&>().measured, self)
                .attr("view")("bool");
          },
          "(k,) bool: measured at the sample itself; else filled from the nearest along the "
          "surface, or infinite.");
  m.def("patches", &patches_of, kPatchesDoc, py::arg("triangles"), py::arg("wanted"),
        py::arg("vertices"));
}

}  // namespace medial::python
