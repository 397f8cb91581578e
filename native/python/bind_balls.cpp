// SPDX-License-Identifier: GPL-3.0-or-later
// Few balls for Python: cover_by_balls.
#include <medial/ball_cover.h>

#include "arrays.h"
#include "bindings.h"

namespace medial::python {
namespace {

constexpr const char* kCoverDoc =
    "A solid as few balls, chosen greedily among `centres` and `radii`, such as the balls of its "
    "inner axis, by the volume\nthat each adds.\n\n"
    "Parameters\n----------\n"
    "centres : (m, 3) float64\n"
    "radii : (m,) float64\n    Of the balls to choose from.\n"
    "vertices : (v, 3) float64\n"
    "triangles : (f, 3) int32\n    The surface of the solid: outward, rows of `vertices`.\n"
    "count : int\n    Balls at most; default 64.\n"
    "mode : CoverMode\n"
    "places : int\n    Of the lattice in the solid, on which volumes are counted; at least half as "
    "many, where a lattice of\n    16 million places in the box of the solid has them; default "
    "100,000.\n"
    "progress : Progress, optional\n"
    "threads : int\n    0: as many as the machine has. The result does not depend on it.\n\n"
    "Returns\n-------\ncover : BallCover\n\n"
    "Raises\n------\nInvalidInputError, Cancelled\n"
    "DegenerateInputError\n    The faces enclose no place, or none of the balls holds one.";

std::span<const double> lengths_of(const py::object& column, const char* name) {
  return column_of<double>(column, name, "(m,) float64");
}

BallCover cover(const py::object& centres, const py::object& radii, const py::object& vertices,
                const py::object& triangles, int64_t count, CoverMode mode, int64_t places,
                Progress* progress, int threads) {
  const Points balls(centres, "centres"), corners(vertices, "vertices");
  const Triangles faces(triangles);
  const BallCoverInput input{balls.span(), lengths_of(radii, "radii"), corners.span(),
                             faces.span()};
  const BallCoverOptions options{.count = count, .mode = mode, .places = places};
  const int wanted = thread_argument(threads);
  const py::gil_scoped_release release;
  return cover_by_balls(input, options, wanted, progress);
}

}  // namespace

void bind_balls(py::module_& m) {
  py::enum_<CoverMode>(m, "CoverMode", py::module_local(), "What `cover_by_balls` promises.")
      .value("INSIDE", CoverMode::inside, "No ball reaches out of the solid.")
      .value("AROUND", CoverMode::around,
             "The balls hold all of the surface, and all places of the lattice in the solid.");
  py::class_<BallCover>(m, "BallCover", "Few balls; made by `cover_by_balls`.", py::is_final(),
                        py::module_local())
      .def_property_readonly("chosen", view_property<int32_t>(&BallCover::chosen),
                             "(n,) int32: rows of the balls to choose from, in the order in which "
                             "they were chosen.")
      .def_property_readonly("radii", view_property<double>(&BallCover::radii),
                             "(n,) float64: inside no longer than to the surface, around grown.")
      .def_property_readonly("covered", view_property<double>(&BallCover::covered),
                             "(n,) float64: share of the places in the solid that the first 1, 2, "
                             "... n balls hold, before they grow.")
      .def_readonly("outside", &BallCover::outside, "No place in a ball is farther from the solid.")
      .def_readonly("farthest", &BallCover::farthest,
                    "No place on the surface is farther from the balls.")
      .def_readonly("places", &BallCover::places, "Of the lattice in the solid.")
      .def_readonly("step", &BallCover::step, "Of the lattice.");
  m.def("cover_by_balls", &cover, kCoverDoc, py::arg("centres"), py::arg("radii"),
        py::arg("vertices"), py::arg("triangles"), py::kw_only(), py::arg("count") = 64,
        py::arg("mode") = CoverMode::inside, py::arg("places") = 100'000,
        py::arg("progress") = nullptr, py::arg("threads") = 0);
}

}  // namespace medial::python
