// SPDX-License-Identifier: GPL-3.0-or-later
// This binds thickness for Python: its modes, its result, and the patches of thin parts.
#include <medial/thickness.h>

#include <array>
#include <memory>
#include <optional>

#include "arrays.h"
#include "base/parallel.h"
#include "base/patches.h"
#include "base/point_tree.h"
#include "base/rows.h"
#include "base/text.h"
#include "bindings.h"
#include "docstrings.h"
#include "inside/surface.h"
#include "thickness/inscribed_balls.h"

namespace medial::python {
namespace {

py::array patches_of(const py::object& triangles, const py::object& wanted, int64_t vertices) {
  const Triangles faces(triangles);
  const auto flags = flags_of(wanted, "wanted");
  const auto rows = faces.span();
  require_one_each(flags.size(), rows.size(), "one flag per triangle",
                   "triangles; pass all of them");
  require_corners(rows, static_cast<size_t>(std::max<int64_t>(vertices, 0)));
  return array_of(released([&] { return patches(rows, flags, static_cast<size_t>(vertices)); }));
}

py::array nearest_rows(const py::object& sites, const py::object& queries) {
  const Points site_rows(sites, "sites"), query_rows(queries, "queries");
  const auto places = site_rows.span(), at = query_rows.span();
  return array_of(released([&] {
    require_finite(places, "site");
    require_finite(at, "query");
    const Run run{thread_count(0)};
    const PointTree sites_tree = PointTree::sorted(places, run);
    std::vector<int32_t> result(at.size(), -1);
    parallel_for(static_cast<int64_t>(at.size()), run,
                 [&](int64_t i) { result[i] = sites_tree.nearest(at[i]).id; });
    return result;
  }));
}

void require_faces(std::span<const int32_t> face, size_t count) {
  for (const int32_t row : face) {
    if (row >= -1 && (row < 0 || static_cast<size_t>(row) < count)) continue;
    throw InvalidInputError("Expected face as rows of the " + std::to_string(count) +
                            " triangles or -1, found " + std::to_string(row) + "; check it.");
  }
}

std::unique_ptr<Faces> faces_of(const py::object& vertices, const py::object& triangles,
                                double sharp_angle, const py::object& sharp_edges, bool smooth,
                                Progress* progress, int threads) {
  const Points rows(vertices, "vertices");
  const Triangles corners(triangles);
  const EdgeRows marked(sharp_edges);
  const FacesInput input{rows.span(), corners.span(), {}, sharp_angle, marked.span(), smooth};
  const Run run{thread_count(thread_argument(threads)), progress};
  const py::gil_scoped_release release;
  return std::make_unique<Faces>(input, Frame{}, run, VertexNormals::fitted);
}

py::tuple creases_of(const Faces& faces) {
  std::vector<Edge> ends;
  std::vector<uint8_t> convex;
  const auto& edges = faces.creases().edges;
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].crease == Crease::none) continue;
    const auto& [a, b] = edges[e].ends;
    ends.push_back({faces.mesh().row[a], faces.mesh().row[b]});
    convex.push_back(faces.is_convex_crease(static_cast<int32_t>(e)));
  }
  std::vector<int32_t> corners;
  for (size_t p = 0; p < faces.creases().corner.size(); ++p) {
    if (faces.creases().corner[p]) corners.push_back(faces.mesh().row[p]);
  }
  return py::make_tuple(array_of(std::move(ends)), array_of<bool>(std::move(convex)),
                        array_of(std::move(corners)));
}

// Places on faces, as they come from Python.
struct GivenPlaces {
  GivenPlaces(const Faces& faces, const py::object& points, const py::object& face,
              const py::array_t<double, py::array::c_style>& spacing, const py::object& normals,
              double rounding)
      : rows(points, "points"),
        places{rows.span(),
               ids_of(face, "face"),
               {spacing.data(), static_cast<size_t>(spacing.size())},
               {},
               rounding} {
    if (!normals.is_none()) places.normals = directions.emplace(normals, "normals").span();
    const size_t count = places.points.size();
    if (directions)
      require_one_each(places.normals.size(), count, "one row of normals per point",
                       "points; pass all of them");
    require_one_each(places.triangle.size(), count, "one row of face per point",
                     "points; pass all of them");
    require_one_each(places.spacing.size(), count, "one row of spacing per point",
                     "points; pass all of them");
    require_finite(places.points, "point");
    require_faces(places.triangle, faces.triangles());
  }
  Points rows;
  std::optional<Points> directions;
  FacePlaces places;
};

py::tuple balls_in_faces(const Faces& faces, const py::object& points, const py::object& face,
                         const py::array_t<double, py::array::c_style>& spacing,
                         const py::object& normals, double rounding, Progress* progress,
                         int threads) {
  const GivenPlaces given(faces, points, face, spacing, normals, rounding);
  const Run run{thread_count(thread_argument(threads)), progress};
  auto found = released([&] { return inscribed_balls(faces, given.places, run); });
  return arrays_of(std::move(found.diameter), std::move(found.wall), std::move(found.parallel));
}

py::tuple rolled_in_faces(const Faces& faces, const py::object& points, const py::object& face,
                          const py::array_t<double, py::array::c_style>& spacing, double rounding,
                          Progress* progress, int threads) {
  const GivenPlaces given(faces, points, face, spacing, py::none(), rounding);
  const Run run{thread_count(thread_argument(threads)), progress};
  auto found = released([&] { return rolled_balls(faces, given.places, run); });
  return arrays_of(std::move(found.wall), std::move(found.parallel));
}

}  // namespace

void bind_thickness(py::module_& m) {
  py::enum_<ThicknessMode>(m, "ThicknessMode", py::module_local(), docs::ThicknessMode)
      .value("WALL", ThicknessMode::wall, docs::ThicknessMode_WALL)
      .value("BALL", ThicknessMode::ball, docs::ThicknessMode_BALL)
      .value("SCAN", ThicknessMode::scan, docs::ThicknessMode_SCAN);
  py::class_<WallThickness> c(m, "WallThickness", docs::WallThickness, py::is_final(),
                              py::module_local());
  add_view(c, "values", &WallThickness::values, docs::WallThickness_values);
  add_view<bool>(c, "measured", &WallThickness::measured, docs::WallThickness_measured);
  m.def("patches", &patches_of, docs::patches, py::arg("triangles"), py::arg("wanted"),
        py::arg("vertices"));
  py::class_<Faces>(m, "BallFaces", docs::BallFaces, py::is_final(), py::module_local())
      .def(py::init(&faces_of), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
           py::arg("sharp_angle") = FacesInput{}.sharp_angle, py::arg("sharp_edges") = py::none(),
           py::arg("smooth") = true, py::arg("progress") = nullptr, py::arg("threads") = 0)
      .def("creases", &creases_of, docs::BallFaces_creases)
      .def("inscribed_balls", &balls_in_faces, docs::BallFaces_inscribed_balls, py::arg("points"),
           py::arg("face"), py::arg("spacing"), py::arg("normals") = py::none(), py::kw_only(),
           py::arg("rounding") = 0.0, py::arg("progress") = nullptr, py::arg("threads") = 0)
      .def("rolled_balls", &rolled_in_faces, docs::BallFaces_rolled_balls, py::arg("points"),
           py::arg("face"), py::arg("spacing"), py::kw_only(), py::arg("rounding") = 0.0,
           py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("nearest", &nearest_rows, docs::nearest, py::arg("sites"), py::arg("queries"));
}

}  // namespace medial::python
