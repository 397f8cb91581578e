// SPDX-License-Identifier: GPL-3.0-or-later
// Hierarchy and Level for Python.
#include <medial/analysis.h>

#include "arrays.h"
#include "bindings.h"
#include "skeleton/level.h"

namespace medial::python {
namespace {

constexpr const char* kHierarchyDoc =
    "All levels of the inner medial axis, from one ordered collapse of the inner Voronoi complex: "
    "each has the topology\nof the solid. Made by `MedialAnalysis.hierarchy`.\n\n"
    "The complex: its vertices are the inner cells, its edges the triangles between two of them, "
    "its facets the Delaunay\nedges all of whose cells are inner. Cells without extent, as of "
    "cospherical samples, are shrunk to what they are. A value says up to which "
    "threshold a cell is there; it is infinite for what no\nthreshold takes away.";

constexpr const char* kExtractLevelDoc =
    "The level at some thresholds. A facet stays if it exceeds the first three. A vertex or an "
    "edge stays if it does, or if\nit exceeds `limb`. What no threshold takes away always "
    "stays.\n\n"
    "Parameters\n----------\n"
    "sheet : float\n    Thickness of the sheet, as a share of the diagonal; default 0. Sheets go "
    "whole.\n"
    "spacings : float\n    The same in local spacings of the samples; default 0. 1 drops what the "
    "samples cannot tell from noise.\n"
    "erosion : float\n    Thickness of the facet itself, as a share of the diagonal; default 0. "
    "Rims recede.\n"
    "limb : float\n    Length of the branch of a wire, as a share of the diagonal; default "
    "0.04.\n"
    "relaxed : bool\n    For the eye: wires are smoothed, divided anew and fitted to the samples "
    "round them, rims are smoothed.\n    The topology and the facets are the same.\n"
    "round_limbs : bool\n    Of wires with a loose end only those that run in round limbs.\n"
    "progress : Progress, optional\n\n"
    "Raises\n------\nInvalidInputError, Cancelled";

constexpr const char* kLevelDoc =
    "One level of a `Hierarchy`: polygons, edges that stand by themselves, and single vertices.";

py::tuple betti_tuple(const Betti& b) { return py::make_tuple(b[0], b[1], b[2]); }

// A property that is a view of an array of the hierarchy.
template <typename Scalar, typename Part>
auto part_property(const Part& part) {
  return [part](const py::object& self) {
    return view_of<Scalar>(part(self.cast<const Hierarchy&>()), self);
  };
}

// The same of places or lengths, which are copied where the hierarchy sees them in another frame.
template <typename Part>
auto framed_property(const Part& part) {
  return [part](const py::object& self) -> py::array {
    const auto& h = self.cast<const Hierarchy&>();
    const Frame& frame = h.parts().frame;
    if (frame.is_plain()) return view_of<double>(part(h), self);
    std::vector values(part(h).begin(), part(h).end());
    for (auto& value : values) value = frame.outward(value);
    return array_of<double>(std::move(values));
  };
}

py::array generator_rows(const Hierarchy& h) {
  std::vector<Edge> rows;
  for (const auto& [p, q] : h.parts().complex.generators) {
    rows.push_back({h.parts().row[p], h.parts().row[q]});
  }
  return array_of<int32_t>(std::move(rows));
}

py::array shrunk_rows(const Hierarchy& h) {
  std::vector<std::array<int32_t, 4>> rows;
  for (const ShrunkFacet& s : h.parts().complex.shrunk) {
    const auto& [p, q] = s.generators;
    rows.push_back({h.parts().row[p], h.parts().row[q], s.edge, s.vertex});
  }
  return array_of<int32_t>(std::move(rows));
}

py::array bubble_rows(const Hierarchy& h) {
  std::vector<int32_t> rows;
  for (const int32_t p : h.parts().complex.bubbles) rows.push_back(h.parts().row[p]);
  return array_of<int32_t>(std::move(rows));
}

template <typename Scalar, typename Corners>
py::array corner_part(const Corners& corners, int32_t Corner::*part) {
  std::vector<Scalar> values;
  values.reserve(corners.size());
  for (const Corner& c : corners) values.push_back(c.*part);
  return array_of<Scalar>(std::move(values));
}

// The values of the edges.
template <typename OfEdge>
py::array edge_values(const Hierarchy& h, const OfEdge& of_edge) {
  const int32_t edges = h.parts().complex.edges();
  std::vector<float> values;
  values.reserve(static_cast<size_t>(edges));
  for (int32_t e = 0; e < edges; ++e) values.push_back(of_edge(h.parts(), e));
  return array_of<float>(std::move(values));
}

// One of the values of each facet or vertex.
py::array value_view(const Array<Thickness>& values, float Thickness::*value,
                     const py::object& owner) {
  const float* first = values.empty() ? nullptr : &(values[0].*value);
  py::array_t<float> array({static_cast<py::ssize_t>(values.size())},
                           {static_cast<py::ssize_t>(sizeof(Thickness))}, first, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

void bind_values(py::class_<Hierarchy>& c, const std::string& name, float Thickness::*value,
                 const char* of_facets) {
  c.def_property_readonly(("facet_" + name).c_str(),
                          [value](const py::object& self) {
                            const auto& h = self.cast<const Hierarchy&>();
                            return value_view(h.parts().values.facet, value, self);
                          },
                          of_facets);
  c.def_property_readonly(("edge_" + name).c_str(),
                          [value](const Hierarchy& h) {
                            return edge_values(h, [&](const auto& parts, int32_t e) {
                              return parts.values.of_edge(parts.partner[e]).*value;
                            });
                          },
                          "(e,) float32: the same of each edge.");
  c.def_property_readonly(("vertex_" + name).c_str(),
                          [value](const py::object& self) {
                            const auto& h = self.cast<const Hierarchy&>();
                            return value_view(h.parts().values.vertex, value, self);
                          },
                          "(v,) float32: the same of each vertex.");
}

void bind_level(py::module_& m) {
  py::class_<Level>(m, "Level", kLevelDoc, py::is_final(), py::module_local())
      .def_property_readonly("vertices", view_property<double>(&Level::vertices),
                             "(v, 3) float64: Voronoi vertices, the centres of empty balls, in "
                             "order of first use. Relaxed: what is shown.")
      .def_property_readonly("radius", view_property<double>(&Level::radius),
                             "(v,) float64: radius of each vertex' ball.")
      .def_property_readonly("exact", view_property<double>(&Level::exact),
                             "(v, 3) float64: where they are on the Voronoi diagram.")
      .def_property_readonly("exact_radius", view_property<double>(&Level::exact_radius),
                             "(v,) float64: radius of the empty ball there.")
      .def_property_readonly("vertex_of", view_property<int32_t>(&Level::vertex_of),
                             "(v,) int32: vertex of the hierarchy; of new ones the nearest along "
                             "the wire.")
      .def_property_readonly("face_offsets", view_property<int32_t>(&Level::face_offsets),
                             "(f + 1,) int32: facet i has the corners "
                             "face_vertices[face_offsets[i] : face_offsets[i + 1]].")
      .def_property_readonly("face_vertices", view_property<int32_t>(&Level::face_vertices),
                             "(c,) int32: vertex ids, facet after facet.")
      .def_property_readonly("generators", view_property<int32_t>(&Level::generators),
                             "(f, 2) int32: rows p < q of the two samples whose cells meet in the "
                             "facet, in lexicographic order.")
      .def_property_readonly("facet_of", view_property<int32_t>(&Level::facet_of),
                             "(f,) int32: facet of the hierarchy.")
      .def_property_readonly("theta", view_property<double>(&Level::theta),
                             "(f,) float64, radians: as in `MedialMesh`, by the rule of the "
                             "hierarchy.")
      .def_property_readonly("rho", view_property<double>(&Level::rho),
                             "(f,) float64: as in `MedialMesh`, by the rule of the hierarchy.")
      .def_property_readonly("sheet", view_property<float>(&Level::sheet),
                             "(f,) float32: `facet_sheet` of each.")
      .def_property_readonly("erosion", view_property<float>(&Level::erosion),
                             "(f,) float32: `facet_erosion` of each.")
      .def_property_readonly("wires", view_property<int32_t>(&Level::wires),
                             "(w, 2) int32: ends of the edges without a facet.")
      .def_property_readonly("edge_of", view_property<int32_t>(&Level::edge_of),
                             "(w,) int32: edge of the hierarchy; of new ones that at the middle.")
      .def_property_readonly("limb", view_property<float>(&Level::limb),
                             "(w,) float32: `edge_limb` of each.")
      .def_property_readonly("points", view_property<int32_t>(&Level::points),
                             "(k,) int32: vertices without an edge.")
      .def_property_readonly(
          "betti", [](const Level& l) { return betti_tuple(l.betti); },
          "Components, tunnels and cavities, counted on the level.")
      .def_readonly("hidden", &Level::hidden,
                    "Edges from a vertex to itself, facets with fewer than three other edges, and "
                    "facets with "
                    "the corners of another one: they count but cannot be drawn.");
}

}  // namespace

void bind_hierarchy(py::module_& m) {
  bind_level(m);
  py::class_<Hierarchy> c(m, "Hierarchy", kHierarchyDoc, py::is_final(), py::module_local());
  c.def_property_readonly(
       "betti", [](const Hierarchy& h) { return betti_tuple(h.betti()); },
       "Components, tunnels and cavities of the complex, and so of every level.")
      .def_property_readonly(
          "bytes", [](const Hierarchy& h) { return h.bytes(); }, "Memory that the hierarchy holds.")
      .def_property_readonly(
          "diagonal", [](const Hierarchy& h) { return h.diagonal(); },
          "Of the box of the samples: the unit of `sheet`, `erosion` and `limb`.")
      .def_property_readonly(
          "cells", part_property<int32_t>([](const Hierarchy& h) -> auto& {
            return h.parts().complex.cell;
          }),
          "(v,) int32: cell of each vertex, the lowest of several in one place, as numbered by "
          "`delaunay` (without a\nbounding sphere).")
      .def_property_readonly("vertices", framed_property([](const Hierarchy& h) -> auto& {
                               return h.parts().complex.position;
                             }),
                             "(v, 3) float64: where they are.")
      .def_property_readonly("radius", framed_property([](const Hierarchy& h) -> auto& {
                               return h.parts().complex.radius;
                             }),
                             "(v,) float64: radius of each vertex' empty ball.")
      .def_property_readonly("edges", part_property<int32_t>([](const Hierarchy& h) -> auto& {
                               return h.parts().complex.ends;
                             }),
                             "(e, 2) int32: ends of each edge, the lower vertex first.")
      .def_property_readonly("generators", &generator_rows,
                             "(f, 2) int32: rows p < q of the samples of each facet.")
      .def_property_readonly(
          "facet_offsets", part_property<int32_t>([](const Hierarchy& h) -> auto& {
            return h.parts().complex.offsets;
          }),
          "(f + 1,) int32: facet i has the corners facet_offsets[i] : facet_offsets[i + 1].")
      .def_property_readonly(
          "facet_vertices",
          [](const Hierarchy& h) {
            return corner_part<int32_t>(h.parts().complex.corners, &Corner::vertex);
          },
          "(c,) int32: vertex at each corner.")
      .def_property_readonly(
          "facet_edges",
          [](const Hierarchy& h) {
            return corner_part<int32_t>(h.parts().complex.corners, &Corner::edge);
          },
          "(c,) int32: edge from each corner to the next.")
      .def_property_readonly("shrunk", &shrunk_rows,
                             "(s, 4) int32: facets without area: rows p < q of the samples, the "
                             "edge that it is or -1, a vertex of it.")
      .def_property_readonly("bubbles", &bubble_rows,
                             "(b,) int32: rows of the samples inside the solid; each is a 3-cell "
                             "of the complex.");
  bind_values(c, "sheet", &Thickness::sheet,
              "(f,) float32: thickness of the thickest facet of the sheet, as a share of the "
              "diagonal, of each facet.");
  bind_values(c, "spacings", &Thickness::spacings,
              "(f,) float32: as `facet_sheet`, in local spacings of the samples.");
  bind_values(c, "erosion", &Thickness::erosion,
              "(f,) float32: erosion thickness as a share of the diagonal: how much later than the "
              "radius of the ball there a fire from\nthe rims comes to the facet; at least that of "
              "all that has to burn before.");
  c.def_property_readonly(
       "edge_limb",
       [](const Hierarchy& h) {
         return edge_values(h, [](const auto& parts, int32_t e) { return parts.limb_of_edge(e); });
       },
       "(e,) float32: length of the branch of each edge, as a share of the diagonal: how long it "
       "is, or how far its tip sticks out,\nwhichever is less; 0 where the edge goes with a facet.")
      .def_property_readonly("vertex_limb", part_property<float>([](const Hierarchy& h) -> auto& {
                               return h.parts().limb;
                             }),
                             "(v,) float32: the same of each vertex; infinite where it stays.")
      .def_property_readonly(
          "timings", [](const Hierarchy& h) { return seconds(h.timings()); },
          "Seconds of each stage, in order.")
      .def(
          "extract",
          [](const Hierarchy& h, double sheet, double spacings, double erosion, double limb,
             bool relaxed, bool round_limbs, Progress* progress) {
            const py::gil_scoped_release release;
            return h.extract({sheet, spacings, erosion, limb, round_limbs, relaxed}, progress);
          },
          kExtractLevelDoc, py::kw_only(), py::arg("sheet") = LevelOptions{}.sheet,
          py::arg("spacings") = LevelOptions{}.spacings,
          py::arg("erosion") = LevelOptions{}.erosion, py::arg("limb") = LevelOptions{}.limb,
          py::arg("relaxed") = LevelOptions{}.relaxed,
          py::arg("round_limbs") = LevelOptions{}.round_limbs, py::arg("progress") = nullptr);
}

}  // namespace medial::python
