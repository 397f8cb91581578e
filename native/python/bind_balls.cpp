// SPDX-License-Identifier: GPL-3.0-or-later
// This binds cover_by_balls and cover_by_capsules for Python.
#include <medial/ball_cover.h>
#include <medial/capsule_cover.h>

#include "arrays.h"
#include "bindings.h"
#include "docstrings.h"

namespace medial::python {
namespace {

std::span<const double> lengths_of(const py::object& column, const char* name) {
  return column_of<double>(column, name, "(m,) float64");
}

BallCover cover(const py::object& centres, const py::object& radii, const py::object& vertices,
                const py::object& triangles, int64_t count, CoverMode mode, int64_t places,
                bool refine, double tolerance, Progress* progress, int threads) {
  const Points balls(centres, "centres"), corners(vertices, "vertices");
  const Triangles faces(triangles);
  const BallCoverInput input{balls.span(), lengths_of(radii, "radii"), corners.span(),
                             faces.span()};
  const BallCoverOptions options{
      .count = count, .mode = mode, .places = places, .refine = refine, .tolerance = tolerance};
  const int wanted = thread_argument(threads);
  const py::gil_scoped_release release;
  return cover_by_balls(input, options, wanted, progress);
}

CapsuleCover cover_round(const py::object& ends, const py::object& segments,
                         const py::object& vertices, const py::object& triangles, int64_t count,
                         CoverMode mode, bool tapered, int64_t places, double tolerance,
                         const py::object& radii, Progress* progress, int threads) {
  const Points rows(ends, "ends"), corners(vertices, "vertices");
  const Triangles faces(triangles);
  CapsuleCoverInput input{rows.span(), edges_of(segments), corners.span(), faces.span(), {}};
  if (!radii.is_none()) input.radii = lengths_of(radii, "radii");
  const CapsuleCoverOptions options{
      .count = count, .mode = mode, .tapered = tapered, .places = places, .tolerance = tolerance};
  const int wanted = thread_argument(threads);
  const py::gil_scoped_release release;
  return cover_by_capsules(input, options, wanted, progress);
}

py::tuple capsules_round_groups(const py::object& places, const py::object& group, int32_t count,
                                bool tapered, int threads) {
  const Points rows(places, "places");
  const auto groups = ids_of(group, "group");
  const int wanted = thread_argument(threads);
  LeastCapsules found =
      released([&] { return least_capsules(rows.span(), groups, count, tapered, wanted); });
  return arrays_of(std::move(found.ends), std::move(found.radii));
}

void bind_capsules(py::module_& m) {
  py::class_<CapsuleCover> c(m, "CapsuleCover", docs::CapsuleCover, py::is_final(),
                             py::module_local());
  add_view(c, "ends", &CapsuleCover::ends, docs::CapsuleCover_ends);
  add_view(c, "radii", &CapsuleCover::radii, docs::CapsuleCover_radii);
  c.def_readonly("held", &CapsuleCover::held, docs::CapsuleCover_held)
      .def_readonly("outside", &CapsuleCover::outside, docs::CapsuleCover_outside)
      .def_readonly("farthest", &CapsuleCover::farthest, docs::CapsuleCover_farthest)
      .def_readonly("places", &CapsuleCover::places, docs::CapsuleCover_places)
      .def_readonly("step", &CapsuleCover::step, docs::CapsuleCover_step);
  m.def("cover_by_capsules", &cover_round, docs::cover_by_capsules, py::arg("ends"),
        py::arg("segments"), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
        py::arg("count") = 64, py::arg("mode") = CoverMode::inside, py::arg("tapered") = true,
        py::arg("places") = 100'000, py::arg("tolerance") = 0.0, py::arg("radii") = py::none(),
        py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("least_capsules", &capsules_round_groups, docs::least_capsules, py::arg("places"),
        py::arg("group"), py::kw_only(), py::arg("count"), py::arg("tapered") = false,
        py::arg("threads") = 0);
}

}  // namespace

void bind_balls(py::module_& m) {
  py::enum_<CoverMode>(m, "CoverMode", py::module_local(), docs::CoverMode)
      .value("INSIDE", CoverMode::inside, docs::CoverMode_INSIDE)
      .value("AROUND", CoverMode::around, docs::CoverMode_AROUND);
  py::class_<BallCover> c(m, "BallCover", docs::BallCover, py::is_final(), py::module_local());
  add_view(c, "chosen", &BallCover::chosen, docs::BallCover_chosen);
  add_view(c, "radii", &BallCover::radii, docs::BallCover_radii);
  add_view(c, "covered", &BallCover::covered, docs::BallCover_covered);
  c.def_readonly("held", &BallCover::held, docs::BallCover_held)
      .def_readonly("outside", &BallCover::outside, docs::BallCover_outside)
      .def_readonly("farthest", &BallCover::farthest, docs::BallCover_farthest)
      .def_readonly("places", &BallCover::places, docs::BallCover_places)
      .def_readonly("step", &BallCover::step, docs::BallCover_step);
  m.def("cover_by_balls", &cover, docs::cover_by_balls, py::arg("centres"), py::arg("radii"),
        py::arg("vertices"), py::arg("triangles"), py::kw_only(), py::arg("count") = 64,
        py::arg("mode") = CoverMode::inside, py::arg("places") = 100'000, py::arg("refine") = true,
        py::arg("tolerance") = 0.0, py::arg("progress") = nullptr, py::arg("threads") = 0);
  bind_capsules(m);
}

}  // namespace medial::python
