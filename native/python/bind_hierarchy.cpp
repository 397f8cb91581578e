// SPDX-License-Identifier: GPL-3.0-or-later
// This binds Hierarchy and Level for Python.
#include <medial/analysis.h>

#include "arrays.h"
#include "bindings.h"
#include "docstrings.h"
#include "exact/held_ball.h"
#include "levels/level.h"

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
  {
    const py::gil_scoped_release release;
    parallel_for(samples ? std::ssize(found) : 0, {h.parts().threads}, [&](int64_t i) {
      const Vec3 place = frame.inward(places[i]);
      const Touch ball =
          way[i] == Vec3{} ? Touch{} : held_ball(*samples, place, normalized(way[i]));
      const bool holds = ball.radius > 0;
      if (holds && ball.position != place) at[i] = frame.outward(ball.position);
      found[i] =
          frame.outward(holds ? ball.radius : samples->within_faces(place, frame.inward(found[i])));
    });
  }
  return py::make_tuple(array_of<double>(std::move(at)), array_of<double>(std::move(found)));
}

// Makes a property that is a view of an array of the hierarchy.
template <typename Scalar, typename Part>
auto part_property(const Part& part) {
  return [part](const py::object& self) {
    return view_of<Scalar>(part(self.cast<const Hierarchy&>()), self);
  };
}

// Does the same for places or lengths, which are copied if the hierarchy holds them in another
// frame.
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
    rows.push_back({(*h.parts().row)[p], (*h.parts().row)[q]});
  }
  return array_of<int32_t>(std::move(rows));
}

py::array shrunk_rows(const Hierarchy& h) {
  std::vector<std::array<int32_t, 4>> rows;
  for (const ShrunkFacet& s : h.parts().complex.shrunk) {
    const auto& [p, q] = s.generators;
    rows.push_back({(*h.parts().row)[p], (*h.parts().row)[q], s.edge, s.vertex});
  }
  return array_of<int32_t>(std::move(rows));
}

py::array bubble_rows(const Hierarchy& h) {
  std::vector<int32_t> rows;
  for (const int32_t p : h.parts().complex.bubbles) rows.push_back((*h.parts().row)[p]);
  return array_of<int32_t>(std::move(rows));
}

template <typename Scalar, typename Corners>
py::array corner_part(const Corners& corners, int32_t Corner::*part) {
  std::vector<Scalar> values;
  values.reserve(corners.size());
  for (const Corner& c : corners) values.push_back(c.*part);
  return array_of<Scalar>(std::move(values));
}

// Returns the values of the edges.
template <typename OfEdge>
py::array edge_values(const Hierarchy& h, const OfEdge& of_edge) {
  const int32_t edges = h.parts().complex.edges();
  std::vector<float> values;
  values.reserve(static_cast<size_t>(edges));
  for (int32_t e = 0; e < edges; ++e) values.push_back(of_edge(h.parts(), e));
  return array_of<float>(std::move(values));
}

// Returns one of the values of each facet or vertex.
py::array value_view(const Array<Thickness>& values, float Thickness::*value,
                     const py::object& owner) {
  const float* first = values.empty() ? nullptr : &(values[0].*value);
  py::array_t<float> array({static_cast<py::ssize_t>(values.size())},
                           {static_cast<py::ssize_t>(sizeof(Thickness))}, first, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

void bind_values(py::class_<Hierarchy>& c, const std::string& name, float Thickness::*value,
                 const char* of_facets, const char* of_edges, const char* of_vertices) {
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
                          of_edges);
  c.def_property_readonly(("vertex_" + name).c_str(),
                          [value](const py::object& self) {
                            const auto& h = self.cast<const Hierarchy&>();
                            return value_view(h.parts().values.vertex, value, self);
                          },
                          of_vertices);
}

void bind_level(py::module_& m) {
  py::class_<Level>(m, "Level", docs::Level, py::is_final(), py::module_local())
      .def_property_readonly("vertices", view_property<double>(&Level::vertices),
                             docs::Level_vertices)
      .def_property_readonly("radius", view_property<double>(&Level::radius), docs::Level_radius)
      .def_property_readonly("exact", view_property<double>(&Level::exact), docs::Level_exact)
      .def_property_readonly("exact_radius", view_property<double>(&Level::exact_radius),
                             docs::Level_exact_radius)
      .def_property_readonly("vertex_of", view_property<int32_t>(&Level::vertex_of),
                             docs::Level_vertex_of)
      .def_property_readonly("place", view_property<uint8_t>(&Level::place), docs::Level_place)
      .def_property_readonly("face_offsets", view_property<int32_t>(&Level::face_offsets),
                             docs::Level_face_offsets)
      .def_property_readonly("face_vertices", view_property<int32_t>(&Level::face_vertices),
                             docs::Level_face_vertices)
      .def_property_readonly("generators", view_property<int32_t>(&Level::generators),
                             docs::Level_generators)
      .def_property_readonly("facet_of", view_property<int32_t>(&Level::facet_of),
                             docs::Level_facet_of)
      .def_property_readonly("theta", view_property<double>(&Level::theta), docs::Level_theta)
      .def_property_readonly("rho", view_property<double>(&Level::rho), docs::Level_rho)
      .def_property_readonly("sheet", view_property<float>(&Level::sheet), docs::Level_sheet)
      .def_property_readonly("erosion", view_property<float>(&Level::erosion), docs::Level_erosion)
      .def_property_readonly("wires", view_property<int32_t>(&Level::wires), docs::Level_wires)
      .def_property_readonly("edge_of", view_property<int32_t>(&Level::edge_of),
                             docs::Level_edge_of)
      .def_property_readonly("limb", view_property<float>(&Level::limb), docs::Level_limb)
      .def_property_readonly("points", view_property<int32_t>(&Level::points), docs::Level_points)
      .def_property_readonly(
          "betti", [](const Level& l) { return betti_tuple(l.betti); }, docs::Level_betti)
      .def_readonly("hidden", &Level::hidden, docs::Level_hidden);
}

}  // namespace

void bind_hierarchy(py::module_& m) {
  bind_level(m);
  py::class_<Hierarchy> c(m, "Hierarchy", docs::Hierarchy, py::is_final(), py::module_local());
  c.def_property_readonly(
       "betti", [](const Hierarchy& h) { return betti_tuple(h.betti()); }, docs::Hierarchy_betti)
      .def_property_readonly(
          "bytes", [](const Hierarchy& h) { return h.bytes(); }, docs::Hierarchy_bytes)
      .def_property_readonly(
          "diagonal", [](const Hierarchy& h) { return h.diagonal(); }, docs::Hierarchy_diagonal)
      .def_property_readonly("cells", part_property<int32_t>([](const Hierarchy& h) -> auto& {
                               return h.parts().complex.cell;
                             }),
                             docs::Hierarchy_cells)
      .def_property_readonly("vertices", framed_property([](const Hierarchy& h) -> auto& {
                               return h.parts().complex.position;
                             }),
                             docs::Hierarchy_vertices)
      .def_property_readonly("radius", framed_property([](const Hierarchy& h) -> auto& {
                               return h.parts().complex.radius;
                             }),
                             docs::Hierarchy_radius)
      .def_property_readonly("crisp_vertices", framed_property([](const Hierarchy& h) -> auto& {
                               return h.parts().crisp.position;
                             }),
                             docs::Hierarchy_crisp_vertices)
      .def_property_readonly("crisp_radius", framed_property([](const Hierarchy& h) -> auto& {
                               return h.parts().crisp.radius;
                             }),
                             docs::Hierarchy_crisp_radius)
      .def_property_readonly(
          "place", [](const Hierarchy& h) { return numbers_of(h.parts().crisp.place); },
          docs::Hierarchy_place)
      .def_property_readonly("on_crease", part_property<uint8_t>([](const Hierarchy& h) -> auto& {
                               return h.parts().on_crease;
                             }),
                             docs::Hierarchy_on_crease)
      .def_property_readonly("edges", part_property<int32_t>([](const Hierarchy& h) -> auto& {
                               return h.parts().complex.ends;
                             }),
                             docs::Hierarchy_edges)
      .def_property_readonly("generators", &generator_rows, docs::Hierarchy_generators)
      .def_property_readonly("facet_offsets", part_property<int32_t>([
                             ](const Hierarchy& h) -> auto& { return h.parts().complex.offsets; }),
                             docs::Hierarchy_facet_offsets)
      .def_property_readonly(
          "facet_vertices",
          [](const Hierarchy& h) {
            return corner_part<int32_t>(h.parts().complex.corners, &Corner::vertex);
          },
          docs::Hierarchy_facet_vertices)
      .def_property_readonly(
          "facet_edges",
          [](const Hierarchy& h) {
            return corner_part<int32_t>(h.parts().complex.corners, &Corner::edge);
          },
          docs::Hierarchy_facet_edges)
      .def_property_readonly("shrunk", &shrunk_rows, docs::Hierarchy_shrunk)
      .def_property_readonly("bubbles", &bubble_rows, docs::Hierarchy_bubbles);
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
      .def_property_readonly("vertex_limb", part_property<float>([](const Hierarchy& h) -> auto& {
                               return h.parts().limb;
                             }),
                             docs::Hierarchy_vertex_limb)
      .def_property_readonly("facet_spike", part_property<float>([](const Hierarchy& h) -> auto& {
                               return spikes(h.parts(), {h.parts().threads}).facet;
                             }),
                             docs::Hierarchy_facet_spike)
      .def_property_readonly(
          "edge_spike",
          [](const Hierarchy& h) {
            const SpikeValues& values = spikes(h.parts(), {h.parts().threads});
            return edge_values(
                h, [&](const auto& parts, int32_t e) { return values.of_edge(parts.partner[e]); });
          },
          docs::Hierarchy_edge_spike)
      .def_property_readonly("vertex_spike", part_property<float>([](const Hierarchy& h) -> auto& {
                               return spikes(h.parts(), {h.parts().threads}).vertex;
                             }),
                             docs::Hierarchy_vertex_spike)
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
