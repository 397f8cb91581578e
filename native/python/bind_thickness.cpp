// SPDX-License-Identifier: GPL-3.0-or-later
// This binds thickness for Python: its modes, its result, and the patches of thin parts.
#include <medial/thickness.h>

#include "arrays.h"
#include "base/parallel.h"
#include "base/patches.h"
#include "base/point_tree.h"
#include "base/rows.h"
#include "bindings.h"
#include "docstrings.h"
#include "inside/surface.h"

namespace medial::python {
namespace {

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

py::array nearest_rows(const py::object& sites, const py::object& queries) {
  const Points site_rows(sites, "sites"), query_rows(queries, "queries");
  const auto places = site_rows.span(), at = query_rows.span();
  std::vector<int32_t> result(at.size(), -1);
  {
    const py::gil_scoped_release release;
    require_finite(places, "site");
    require_finite(at, "query");
    const Run run{thread_count(0)};
    const PointTree sites_tree = PointTree::sorted(places, run);
    parallel_for(static_cast<int64_t>(at.size()), run,
                 [&](int64_t i) { result[i] = sites_tree.nearest(at[i]).id; });
  }
  return array_of<int32_t>(std::move(result));
}

}  // namespace

void bind_thickness(py::module_& m) {
  py::enum_<ThicknessMode>(m, "ThicknessMode", py::module_local(), docs::ThicknessMode)
      .value("WALL", ThicknessMode::wall, docs::ThicknessMode_WALL)
      .value("BALL", ThicknessMode::ball, docs::ThicknessMode_BALL)
      .value("SCAN", ThicknessMode::scan, docs::ThicknessMode_SCAN);
  py::class_<WallThickness>(m, "WallThickness", docs::WallThickness, py::is_final(),
                            py::module_local())
      .def_property_readonly("values", view_property<double>(&WallThickness::values),
                             docs::WallThickness_values)
      .def_property_readonly(
          "measured",
          [](const py::object& self) {
            return view_of<uint8_t>(self.cast<const WallThickness&>().measured, self)
                .attr("view")("bool");
          },
          docs::WallThickness_measured);
  m.def("patches", &patches_of, docs::patches, py::arg("triangles"), py::arg("wanted"),
        py::arg("vertices"));
  m.def("nearest", &nearest_rows, docs::nearest, py::arg("sites"), py::arg("queries"));
}

}  // namespace medial::python
