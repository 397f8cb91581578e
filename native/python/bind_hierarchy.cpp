// SPDX-License-Identifier: GPL-3.0-or-later
// This binds Hierarchy and Level for Python.
#include <medial/analysis.h>

#include "arrays.h"
#include "bindings.h"
#include "docstrings.h"
#include "exact/held_ball.h"
#include "levels/level.h"
#include "levels/smooth_line.h"

namespace medial::python {
namespace {

py::tuple betti_tuple(const Betti& b) { return py::make_tuple(b[0], b[1], b[2]); }

py::tuple held_balls(const Hierarchy& h, const py::object& centres,
                     const py::array_t<double, py::array::c_style>& radii,
                     const py::object& along) {
  const Points rows(centres, "centres"), ways(along, "along");
  const auto places = rows.span(), way = ways.span();
  const Frame& frame = h.parts().frame;
  const auto& samples = h.parts().on_faces;
  std::vector<double> found(radii.data(), radii.data() + radii.size());
  std::vector<Vec3> at(places.begin(), places.end());
  if (found.size() != places.size() || way.size() != places.size()) {
    throw InvalidInputError("Expected a radius and a direction for each centre, found " +
                            std::to_string(found.size()) + " and " + std::to_string(way.size()) +
                            "; pass as many of all");
  }
  released([&] {
    parallel_for(samples ? std::ssize(found) : 0, {h.parts().threads}, [&](int64_t i) {
      const Vec3 place = frame.inward(places[i]);
      const Touch ball =
          way[i] == Vec3{} ? Touch{} : held_ball(*samples, place, normalized(way[i]));
      const bool holds = ball.radius > 0;
      if (holds && ball.position != place) at[i] = frame.outward(ball.position);
      found[i] =
          frame.outward(holds ? ball.radius : samples->within_faces(place, frame.inward(found[i])));
    });
  });
  return arrays_of(std::move(at), std::move(found));
}

py::array smooth(const py::object& places, const py::object& widths) {
  const Points rows(places, "places");
  const auto width = column_of<double>(widths, "widths", "(n,) float64");
  if (width.size() != rows.span().size()) {
    throw InvalidInputError("Expected a width for each place, found " +
                            std::to_string(width.size()) + "; pass as many of both");
  }
  return array_of(released([&] { return smooth_line(rows.span(), width); }));
}

// Adds a property that is a view of an array of the hierarchy.
template <typename Part>
void add_part(py::class_<Hierarchy>& c, const char* name, const char* doc, const Part& part) {
  const auto view = [part](const py::object& self) {
    return view_of(part(self.cast<const Hierarchy&>().parts()), self);
  };
  c.def_property_readonly(name, view, doc);
}

// Does the same for places or lengths, which are copied if the hierarchy holds them in another
// frame.
template <typename Part>
void add_framed(py::class_<Hierarchy>& c, const char* name, const char* doc, const Part& part) {
  const auto view = [part](const py::object& self) -> py::array {
    const auto& h = self.cast<const Hierarchy&>().parts();
    if (h.frame.is_plain()) return view_of(part(h), self);
    std::vector values(part(h).begin(), part(h).end());
    for (auto& value : values) value = h.frame.outward(value);
    return array_of(std::move(values));
  };
  c.def_property_readonly(name, view, doc);
}

py::array generator_rows(const Hierarchy& h) {
  std::vector<Edge> rows;
  for (const auto& [p, q] : h.parts().complex.generators) {
    rows.push_back({(*h.parts().row)[p], (*h.parts().row)[q]});
  }
  return array_of(std::move(rows));
}

py::array shrunk_rows(const Hierarchy& h) {
  std::vector<std::array<int32_t, 4>> rows;
  for (const ShrunkFacet& s : h.parts().complex.shrunk) {
    const auto& [p, q] = s.generators;
    rows.push_back({(*h.parts().row)[p], (*h.parts().row)[q], s.edge, s.vertex});
  }
  return array_of(std::move(rows));
}

py::array bubble_rows(const Hierarchy& h) {
  std::vector<int32_t> rows;
  for (const int32_t p : h.parts().complex.bubbles) rows.push_back((*h.parts().row)[p]);
  return array_of(std::move(rows));
}

auto corner_property(int32_t Corner::*part) {
  return [part](const Hierarchy& h) {
    std::vector<int32_t> values;
    values.reserve(h.parts().complex.corners.size());
    for (const Corner& c : h.parts().complex.corners) values.push_back(c.*part);
    return array_of(std::move(values));
  };
}

// Returns the values of the edges.
template <typename OfEdge>
py::array edge_values(const Hierarchy& h, const OfEdge& of_edge) {
  const int32_t edges = h.parts().complex.edges();
  std::vector<float> values;
  values.reserve(static_cast<size_t>(edges));
  for (int32_t e = 0; e < edges; ++e) values.push_back(of_edge(h.parts(), e));
  return array_of(std::move(values));
}

// Makes a property of one of the values of each facet or vertex.
auto value_property(Array<Thickness> Values::*of, float Thickness::*value) {
  return [of, value](const py::object& self) {
    const auto& values = self.cast<const Hierarchy&>().parts().values.*of;
    const float* first = values.empty() ? nullptr : &(values[0].*value);
    py::array_t<float> array({static_cast<py::ssize_t>(values.size())},
                             {static_cast<py::ssize_t>(sizeof(Thickness))}, first, self);
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
  };
}

void bind_values(py::class_<Hierarchy>& c, const std::string& name, float Thickness::*value,
                 const char* of_facets, const char* of_edges, const char* of_vertices) {
  const auto of_edge = [value](const Hierarchy& h) {
    return edge_values(h, [&](const auto& parts, int32_t e) {
      return parts.values.of_edge(parts.partner[e]).*value;
    });
  };
  c.def_property_readonly(("facet_" + name).c_str(), value_property(&Values::facet, value),
                          of_facets);
  c.def_property_readonly(("edge_" + name).c_str(), of_edge, of_edges);
  c.def_property_readonly(("vertex_" + name).c_str(), value_property(&Values::vertex, value),
                          of_vertices);
}

void bind_level(py::module_& m) {
  py::class_<Level> c(m, "Level", docs::Level, py::is_final(), py::module_local());
  add_view(c, "vertices", &Level::vertices, docs::Level_vertices);
  add_view(c, "radius", &Level::radius, docs::Level_radius);
  add_view(c, "exact", &Level::exact, docs::Level_exact);
  add_view(c, "exact_radius", &Level::exact_radius, docs::Level_exact_radius);
  add_view(c, "vertex_of", &Level::vertex_of, docs::Level_vertex_of);
  add_view(c, "place", &Level::place, docs::Level_place);
  add_view(c, "face_offsets", &Level::face_offsets, docs::Level_face_offsets);
  add_view(c, "face_vertices", &Level::face_vertices, docs::Level_face_vertices);
  add_view(c, "generators", &Level::generators, docs::Level_generators);
  add_view(c, "facet_of", &Level::facet_of, docs::Level_facet_of);
  add_view(c, "theta", &Level::theta, docs::Level_theta);
  add_view(c, "rho", &Level::rho, docs::Level_rho);
  add_view(c, "sheet", &Level::sheet, docs::Level_sheet);
  add_view(c, "erosion", &Level::erosion, docs::Level_erosion);
  add_view(c, "wires", &Level::wires, docs::Level_wires);
  add_view(c, "edge_of", &Level::edge_of, docs::Level_edge_of);
  add_view(c, "limb", &Level::limb, docs::Level_limb);
  add_view(c, "points", &Level::points, docs::Level_points);
  c.def_property_readonly(
       "betti", [](const Level& l) { return betti_tuple(l.betti); }, docs::Level_betti)
      .def_readonly("hidden", &Level::hidden, docs::Level_hidden);
}

}  // namespace

void bind_hierarchy(py::module_& m) {
  bind_level(m);
  m.def("smooth_line", &smooth, docs::smooth_line, py::arg("places"), py::arg("widths"));
  py::class_<Hierarchy> c(m, "Hierarchy", docs::Hierarchy, py::is_final(), py::module_local());
  c.def_property_readonly(
       "betti", [](const Hierarchy& h) { return betti_tuple(h.betti()); }, docs::Hierarchy_betti)
      .def_property_readonly("bytes", &Hierarchy::bytes, docs::Hierarchy_bytes)
      .def_property_readonly("diagonal", &Hierarchy::diagonal, docs::Hierarchy_diagonal)
      .def_property_readonly(
          "place", [](const Hierarchy& h) { return numbers_of(h.parts().crisp.place); },
          docs::Hierarchy_place)
      .def_property_readonly("generators", &generator_rows, docs::Hierarchy_generators)
      .def_property_readonly("facet_vertices", corner_property(&Corner::vertex),
                             docs::Hierarchy_facet_vertices)
      .def_property_readonly("facet_edges", corner_property(&Corner::edge),
                             docs::Hierarchy_facet_edges)
      .def_property_readonly("shrunk", &shrunk_rows, docs::Hierarchy_shrunk)
      .def_property_readonly("bubbles", &bubble_rows, docs::Hierarchy_bubbles);
  add_part(
      c, "cells", docs::Hierarchy_cells, [](const auto& h) -> auto& { return h.complex.cell; });
  add_part(
      c, "edges", docs::Hierarchy_edges, [](const auto& h) -> auto& { return h.complex.ends; });
  add_part(
      c, "facet_offsets", docs::Hierarchy_facet_offsets,
      [](const auto& h) -> auto& { return h.complex.offsets; });
  add_part(
      c, "on_crease", docs::Hierarchy_on_crease,
      [](const auto& h) -> auto& { return h.on_crease; });
  add_part(
      c, "vertex_limb", docs::Hierarchy_vertex_limb, [](const auto& h) -> auto& { return h.limb; });
  add_part(
      c, "facet_spike", docs::Hierarchy_facet_spike,
      [](const auto& h) -> auto& { return spikes(h, {h.threads}).facet; });
  add_part(
      c, "vertex_spike", docs::Hierarchy_vertex_spike,
      [](const auto& h) -> auto& { return spikes(h, {h.threads}).vertex; });
  add_framed(
      c, "vertices", docs::Hierarchy_vertices,
      [](const auto& h) -> auto& { return h.complex.position; });
  add_framed(
      c, "radius", docs::Hierarchy_radius, [](const auto& h) -> auto& { return h.complex.radius; });
  add_framed(
      c, "crisp_vertices", docs::Hierarchy_crisp_vertices,
      [](const auto& h) -> auto& { return h.crisp.position; });
  add_framed(
      c, "crisp_radius", docs::Hierarchy_crisp_radius,
      [](const auto& h) -> auto& { return h.crisp.radius; });
  bind_values(c, "sheet", &Thickness::sheet, docs::Hierarchy_facet_sheet,
              docs::Hierarchy_edge_sheet, docs::Hierarchy_vertex_sheet);
  bind_values(c, "spacings", &Thickness::spacings, docs::Hierarchy_facet_spacings,
              docs::Hierarchy_edge_spacings, docs::Hierarchy_vertex_spacings);
  bind_values(c, "erosion", &Thickness::erosion, docs::Hierarchy_facet_erosion,
              docs::Hierarchy_edge_erosion, docs::Hierarchy_vertex_erosion);
  c.def_property_readonly(
       "edge_limb",
       [](const Hierarchy& h) {
         return edge_values(h, [](const auto& parts, int32_t e) { return parts.limb_of_edge(e); });
       },
       docs::Hierarchy_edge_limb)
      .def_property_readonly(
          "edge_spike",
          [](const Hierarchy& h) {
            const SpikeValues& values = spikes(h.parts(), {h.parts().threads});
            return edge_values(
                h, [&](const auto& parts, int32_t e) { return values.of_edge(parts.partner[e]); });
          },
          docs::Hierarchy_edge_spike)
      .def_property_readonly(
          "timings", [](const Hierarchy& h) { return seconds(h.timings()); },
          docs::Hierarchy_timings)
      .def("held_balls", &held_balls, docs::Hierarchy_held_balls, py::arg("centres"),
           py::arg("radii"), py::arg("along"))
      .def(
          "even",
          [](const Hierarchy& h, double spacings, double limb, bool round_limbs, bool crisp,
             Progress* progress) {
            const py::gil_scoped_release release;
            return h.even({spacings, limb, round_limbs, crisp}, progress);
          },
          docs::Hierarchy_even, py::kw_only(), py::arg("spacings") = EvenOptions{}.spacings,
          py::arg("limb") = EvenOptions{}.limb, py::arg("round_limbs") = EvenOptions{}.round_limbs,
          py::arg("crisp") = EvenOptions{}.crisp, py::arg("progress") = nullptr)
      .def(
          "selecting",
          [](const Hierarchy& h, double theta, double rho, Progress* progress) {
            const py::gil_scoped_release release;
            return h.selecting(theta, rho, progress);
          },
          docs::Hierarchy_selecting, py::arg("theta"), py::arg("rho"), py::kw_only(),
          py::arg("progress") = nullptr)
      .def(
          "extract",
          [](const Hierarchy& h, double sheet, double spacings, double erosion, double spike,
             double limb, bool relaxed, bool round_limbs, bool crisp, Progress* progress) {
            const py::gil_scoped_release release;
            return h.extract({sheet, spacings, erosion, spike, limb, round_limbs, relaxed, crisp},
                             progress);
          },
          docs::Hierarchy_extract, py::kw_only(), py::arg("sheet") = LevelOptions{}.sheet,
          py::arg("spacings") = LevelOptions{}.spacings,
          py::arg("erosion") = LevelOptions{}.erosion, py::arg("spike") = LevelOptions{}.spike,
          py::arg("limb") = LevelOptions{}.limb, py::arg("relaxed") = LevelOptions{}.relaxed,
          py::arg("round_limbs") = LevelOptions{}.round_limbs,
          py::arg("crisp") = LevelOptions{}.crisp, py::arg("progress") = nullptr);
}

}  // namespace medial::python
