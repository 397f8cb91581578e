// SPDX-License-Identifier: GPL-3.0-or-later
// This binds Progress, MedialAnalysis and MedialMesh for Python.
#include <medial/analysis.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "docstrings.h"

namespace medial::python {
namespace {

std::optional<Points> optional_points(const py::object& rows, const char* name) {
  return rows.is_none() ? std::optional<Points>() : Points(rows, name);
}

std::optional<std::span<const int32_t>> optional_ids(const py::object& ids, const char* name) {
  return ids.is_none() ? std::optional<std::span<const int32_t>>() : ids_of(ids, name);
}

// The faces of a hierarchy. Keeps the arrays that the input of the core refers to.
class FacesArgument {
 public:
  FacesArgument(const py::object& vertices, const py::object& triangles, const py::object& face,
                double sharp_angle, const py::object& sharp_edges, bool smooth)
      : vertices_(vertices, "vertices"),
        triangles_(triangles),
        face_object_(face),
        face_(ids_of(face, "face")),
        sharp_edges_(sharp_edges),
        sharp_angle_(sharp_angle),
        smooth_(smooth) {}

  FacesInput input() const {
    return {vertices_.span(), triangles_.span(), face_, sharp_angle_, sharp_edges_.span(), smooth_};
  }

 private:
  Points vertices_;
  Triangles triangles_;
  py::object face_object_;
  std::span<const int32_t> face_;
  EdgeRows sharp_edges_;
  double sharp_angle_;
  bool smooth_;
};

std::unique_ptr<MedialAnalysis> analyse(const py::object& points, const py::object& triangles,
                                        const py::object& vertices, const py::object& normals,
                                        SidesFrom sides, const CoconeOptions* cocone,
                                        bool bounding_sphere, Progress* progress, int threads) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  const auto oriented = optional_points(normals, "normals");
  const auto corners = optional_points(vertices, "vertices");
  const AnalysisOptions options{sides, cocone ? *cocone : CoconeOptions{}, bounding_sphere,
                                thread_argument(threads)};
  AnalysisInput input{rows.span(), faces.span()};
  if (oriented) input.normals = oriented->span();
  if (corners) input.vertices = corners->span();
  const py::gil_scoped_release release;
  return std::make_unique<MedialAnalysis>(input, options, progress);
}

WallThickness thickness_of(const MedialAnalysis& analysis, const py::object& normals,
                           const py::object& edges, ThicknessMode mode, Side side, double theta,
                           double rho, Rule rule, Criteria criteria, Progress* progress) {
  const auto directions = optional_points(normals, "normals");
  ThicknessInput input;
  if (directions) input.normals = directions->span();
  if (!edges.is_none()) input.at_edge = flags_of(edges, "edges");
  const ThicknessOptions options{mode, side, {theta, rho, rule, criteria}};
  const py::gil_scoped_release release;
  return analysis.thickness(input, options, progress);
}

Extraction extraction(double theta, double rho, Side side, Rule rule, Criteria criteria,
                      bool limit_set) {
  return {{theta, rho, rule, criteria}, side, limit_set};
}

void bind_enums(py::module_& m) {
  py::enum_<Side>(m, "Side", py::module_local(), docs::Side)
      .value("BOTH", Side::both, docs::Side_BOTH)
      .value("INNER", Side::inner, docs::Side_INNER)
      .value("OUTER", Side::outer, docs::Side_OUTER)
      .value("CROSSING", Side::crossing, docs::Side_CROSSING);
  py::enum_<SidesFrom>(m, "SidesFrom", py::module_local(), docs::SidesFrom)
      .value("AUTOMATIC", SidesFrom::automatic, docs::SidesFrom_AUTOMATIC)
      .value("SURFACE", SidesFrom::surface, docs::SidesFrom_SURFACE)
      .value("NORMALS", SidesFrom::normals, docs::SidesFrom_NORMALS)
      .value("TIGHT_COCONE", SidesFrom::tight_cocone, docs::SidesFrom_TIGHT_COCONE)
      .value("NONE", SidesFrom::none, docs::SidesFrom_NONE)
      .value("POLES", SidesFrom::poles, docs::SidesFrom_POLES);
  py::enum_<Rule>(m, "Rule", py::module_local(), docs::Rule)
      .value("EITHER", Rule::either, docs::Rule_EITHER)
      .value("BOTH", Rule::both, docs::Rule_BOTH);
  py::enum_<Criteria>(m, "Criteria", py::module_local(), docs::Criteria)
      .value("ANGLE_OR_RATIO", Criteria::angle_or_ratio)
      .value("ANGLE", Criteria::angle)
      .value("RATIO", Criteria::ratio);
}

void bind_progress(py::module_& m) {
  py::class_<Progress>(m, "Progress", docs::Progress, py::is_final(), py::module_local())
      .def(py::init<>())
      .def_property_readonly("fraction", &Progress::fraction, docs::Progress_fraction)
      .def_property_readonly("stage", &Progress::stage, docs::Progress_stage)
      .def_property_readonly("cancelled", &Progress::cancelled, docs::Progress_cancelled)
      .def("cancel", &Progress::cancel, docs::Progress_cancel);
}

void bind_faces(py::module_& m) {
  const FacesInput defaults;
  py::class_<FacesArgument>(m, "Faces", docs::Faces, py::is_final(), py::module_local())
      .def(py::init<const py::object&, const py::object&, const py::object&, double,
                    const py::object&, bool>(),
           py::arg("vertices"), py::arg("triangles"), py::arg("face"), py::kw_only(),
           py::arg("sharp_angle") = defaults.sharp_angle, py::arg("sharp_edges") = py::none(),
           py::arg("smooth") = defaults.smooth);
}

void bind_mesh(py::module_& m) {
  py::class_<MedialMesh> c(m, "MedialMesh", docs::MedialMesh, py::is_final(), py::module_local());
  add_view(c, "vertices", &MedialMesh::vertices, docs::MedialMesh_vertices);
  add_view(c, "radius", &MedialMesh::radius, docs::MedialMesh_radius);
  add_view(c, "face_offsets", &MedialMesh::face_offsets, docs::MedialMesh_face_offsets);
  add_view(c, "face_vertices", &MedialMesh::face_vertices, docs::MedialMesh_face_vertices);
  add_view(c, "theta", &MedialMesh::theta, docs::MedialMesh_theta);
  add_view(c, "rho", &MedialMesh::rho, docs::MedialMesh_rho);
  add_view(c, "generators", &MedialMesh::generators, docs::MedialMesh_generators);
  add_view(c, "edges", &MedialMesh::edges, docs::MedialMesh_edges);
  c.def_property_readonly(
       "side", [](const MedialMesh& mesh) { return numbers_of(mesh.side); }, docs::MedialMesh_side)
      .def_readonly("unbounded", &MedialMesh::unbounded, docs::MedialMesh_unbounded)
      .def_readonly("zero_area", &MedialMesh::zero_area, docs::MedialMesh_zero_area)
      .def_readonly("rings", &MedialMesh::rings, docs::MedialMesh_rings);
}

// Makes a property of what a function of the analysis returns.
template <typename Number = void, typename Rows>
auto found_property(Rows (MedialAnalysis::*member)() const) {
  return [member](const MedialAnalysis& a) { return array_of<Number>((a.*member)()); };
}

auto theta_property(Rule rule) {
  return [rule](const MedialAnalysis& a) { return array_of(a.theta(rule)); };
}

auto rho_property(Rule rule) {
  return [rule](const MedialAnalysis& a) { return array_of(a.rho(rule)); };
}

}  // namespace

void bind_analysis(py::module_& m) {
  bind_enums(m);
  bind_progress(m);
  bind_faces(m);
  bind_mesh(m);
  bind_hierarchy(m);
  bind_thickness(m);
  m.def("memory_needed", &memory_needed, docs::memory_needed, py::arg("points"));
  m.def("automatic_sides", &automatic_sides, docs::automatic_sides, py::arg("bounded"),
        py::arg("has_normals"));
  const Thresholds paper;
  py::class_<MedialAnalysis>(m, "MedialAnalysis", docs::MedialAnalysis, py::is_final(),
                             py::module_local())
      .def(py::init(&analyse), py::arg("points"), py::arg("triangles") = py::none(), py::kw_only(),
           py::arg("vertices") = py::none(), py::arg("normals") = py::none(),
           py::arg("sides") = SidesFrom::automatic, py::arg("cocone") = py::none(),
           py::arg("bounding_sphere") = false, py::arg("progress") = nullptr,
           py::arg("threads") = 0)
      .def_property_readonly("samples", found_property(&MedialAnalysis::sample_rows),
                             docs::MedialAnalysis_samples)
      .def_property_readonly("bytes", &MedialAnalysis::bytes, docs::MedialAnalysis_bytes)
      .def_property_readonly("duplicates", &MedialAnalysis::duplicates,
                             docs::MedialAnalysis_duplicates)
      .def_property_readonly("edges", found_property(&MedialAnalysis::edge_rows),
                             docs::MedialAnalysis_edges)
      .def_property_readonly("theta", theta_property(Rule::either), docs::MedialAnalysis_theta)
      .def_property_readonly("rho", rho_property(Rule::either), docs::MedialAnalysis_rho)
      .def_property_readonly("theta_both", theta_property(Rule::both),
                             docs::MedialAnalysis_theta_both)
      .def_property_readonly("rho_both", rho_property(Rule::both), docs::MedialAnalysis_rho_both)
      .def_property_readonly(
          "side", [](const MedialAnalysis& a) { return numbers_of(a.edge_sides()); },
          docs::MedialAnalysis_side)
      .def_property_readonly("sides_from", &MedialAnalysis::sides_from,
                             docs::MedialAnalysis_sides_from)
      .def_property_readonly("pole_disagreement", &MedialAnalysis::pole_disagreement,
                             docs::MedialAnalysis_pole_disagreement)
      .def_property_readonly(
          "tight_cocone",
          [](const MedialAnalysis& a) {
            return std::const_pointer_cast<WatertightSurface>(a.tight_cocone());
          },
          docs::MedialAnalysis_tight_cocone)
      .def_property_readonly("bounded", found_property<bool>(&MedialAnalysis::edges_bounded),
                             docs::MedialAnalysis_bounded)
      .def_property_readonly("closed", &MedialAnalysis::closed, docs::MedialAnalysis_closed)
      .def_property_readonly("boundary_edges", &MedialAnalysis::boundary_edges,
                             docs::MedialAnalysis_boundary_edges)
      .def_property_readonly("cells", &MedialAnalysis::finite_cells, docs::MedialAnalysis_cells)
      .def_property_readonly(
          "timings", [](const MedialAnalysis& a) { return seconds(a.timings()); },
          docs::MedialAnalysis_timings)
      .def_property_readonly("spacing", found_property(&MedialAnalysis::spacing),
                             docs::MedialAnalysis_spacing)
      .def(
          "feature_size",
          [](const MedialAnalysis& a, double theta, double rho, Rule rule, Criteria criteria,
             const py::object& rows, Progress* progress) {
            const auto chosen = optional_ids(rows, "rows");
            return array_of(released([&] {
              return a.feature_size({theta, rho, rule, criteria}, chosen, progress);
            }));
          },
          docs::MedialAnalysis_feature_size, py::arg("theta") = paper.theta,
          py::arg("rho") = paper.rho, py::arg("rule") = paper.rule,
          py::arg("criteria") = paper.criteria, py::kw_only(), py::arg("rows") = py::none(),
          py::arg("progress") = nullptr)
      .def("thickness", &thickness_of, docs::MedialAnalysis_thickness,
           py::arg("normals") = py::none(), py::kw_only(), py::arg("edges") = py::none(),
           py::arg("mode") = ThicknessMode::wall, py::arg("side") = Side::inner,
           py::arg("theta") = paper.theta, py::arg("rho") = paper.rho, py::arg("rule") = paper.rule,
           py::arg("criteria") = paper.criteria, py::arg("progress") = nullptr)
      .def(
          "doubts",
          [](const MedialAnalysis& a, const py::object& vertices, const py::object& triangles,
             const py::object& normals,
             const py::array_t<double, py::array::c_style | py::array::forcecast>& reach,
             Progress* progress) {
            const Points corners(vertices, "vertices"), directions(normals, "normals");
            const Triangles faces(triangles);
            const std::span<const double> reaches(reach.data(), static_cast<size_t>(reach.size()));
            auto found = released([&] {
              return a.doubts(corners.span(), faces.span(), directions.span(), reaches, progress);
            });
            return arrays_of(std::move(found.places), std::move(found.gaps));
          },
          docs::MedialAnalysis_doubts, py::arg("vertices"), py::arg("triangles"),
          py::arg("normals"), py::arg("reach"), py::kw_only(), py::arg("progress") = nullptr)
      .def(
          "solid_triangles",
          [](const MedialAnalysis& a) {
            return array_of(released([&] { return a.solid_triangles(); }));
          },
          docs::MedialAnalysis_solid_triangles)
      .def(
          "hierarchy",
          [](const MedialAnalysis& a, double theta, double rho, Rule rule, Criteria criteria,
             Side side, std::optional<int64_t> bodies, const FacesArgument* faces,
             const py::object& partners, bool places, Progress* progress) {
            const auto input = faces ? std::optional(faces->input()) : std::nullopt;
            const auto rows =
                partners.is_none() ? std::span<const int32_t>() : ids_of(partners, "partners");
            const py::gil_scoped_release release;
            return a.hierarchy({theta, rho, rule, criteria}, side, bodies, progress,
                               input ? &*input : nullptr, rows, places);
          },
          docs::MedialAnalysis_hierarchy, py::arg("theta") = paper.theta,
          py::arg("rho") = paper.rho, py::arg("rule") = paper.rule,
          py::arg("criteria") = paper.criteria, py::arg("side") = Side::inner, py::kw_only(),
          py::arg("bodies") = py::none(), py::arg("faces") = nullptr,
          py::arg("partners") = py::none(), py::arg("places") = true, py::arg("progress") = nullptr)
      .def(
          "select",
          [](const MedialAnalysis& a, double theta, double rho, Side side, Rule rule,
             Criteria criteria, bool limit_set) {
            const auto wanted = extraction(theta, rho, side, rule, criteria, limit_set);
            return array_of(released([&] { return a.select(wanted); }));
          },
          docs::MedialAnalysis_select, py::arg("theta") = paper.theta, py::arg("rho") = paper.rho,
          py::arg("side") = Side::both, py::arg("rule") = paper.rule,
          py::arg("criteria") = paper.criteria, py::kw_only(), py::arg("limit_set") = false)
      .def(
          "extract",
          [](const MedialAnalysis& a, double theta, double rho, Side side, Rule rule,
             Criteria criteria, bool limit_set, Progress* progress) {
            const py::gil_scoped_release release;
            return a.extract(extraction(theta, rho, side, rule, criteria, limit_set), progress);
          },
          docs::MedialAnalysis_extract, py::arg("theta") = paper.theta, py::arg("rho") = paper.rho,
          py::arg("side") = Side::both, py::arg("rule") = paper.rule,
          py::arg("criteria") = paper.criteria, py::kw_only(), py::arg("limit_set") = false,
          py::arg("progress") = nullptr);
}

}  // namespace medial::python
