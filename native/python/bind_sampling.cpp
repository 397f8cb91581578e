// SPDX-License-Identifier: GPL-3.0-or-later
// This binds sample_surface for Python.
#include <medial/sampling.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/rows.h"
#include "base/text.h"
#include "bindings.h"
#include "docstrings.h"
#include "sampling/closing_samples.h"

namespace medial::python {
namespace {

using FloatArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

// This holds sites and their spacings, and keeps what the options refer to.
class Sizing {
 public:
  explicit Sizing(const py::object& object) {
    if (object.is_none()) return;
    if (!py::isinstance<py::tuple>(object) || py::len(object) != 2) {
      throw InvalidInputError("Expected sizing as a pair of sites and spacings, found " +
                              describe(object) + "; give both.");
    }
    const py::object spacings = object[py::int_(1)];
    const bool array = py::isinstance<py::array>(spacings);
    const auto view = array ? py::reinterpret_borrow<py::array>(spacings) : py::array();
    if (!array || view.ndim() != 1 || view.dtype().kind() != 'f') {
      throw InvalidInputError("Expected spacings of the sites as a (k,) float64 array, found " +
                              describe(spacings) + "; convert it.");
    }
    sites_.emplace(object[py::int_(0)], "sites");
    spacings_ = FloatArray::ensure(view);
  }

  void put_into(SamplingOptions& options) const {
    if (!sites_) return;
    options.sites = sites_->span();
    options.site_spacings = {spacings_.data(), static_cast<size_t>(spacings_.size())};
  }

 private:
  std::optional<Points> sites_;
  FloatArray spacings_;
};

std::shared_ptr<SurfaceSamples> sample(const py::object& vertices, const py::object& triangles,
                                       std::optional<int64_t> count, std::optional<double> spacing,
                                       const py::object& sizing, double sharp_angle,
                                       const py::object& sharp_edges, bool smooth,
                                       bool keep_vertices, int mirrored_rows, bool pairs,
                                       int64_t seed, Progress* progress, int threads) {
  const Points points(vertices, "vertices");
  const Triangles faces(py::reinterpret_borrow<py::object>(triangles));
  const Sizing sizes(sizing);
  const EdgeRows marked(sharp_edges);
  SamplingOptions options;
  options.count = count;
  options.spacing = spacing;
  sizes.put_into(options);
  options.sharp_angle = sharp_angle;
  options.sharp_edges = marked.span();
  options.smooth = smooth;
  options.keep_vertices = keep_vertices;
  options.mirrored_rows = mirrored_rows;
  options.pairs = pairs;
  options.seed = static_cast<uint64_t>(seed);
  const int team = thread_argument(threads);
  const auto point_span = points.span();
  const auto face_span = faces.span();
  const py::gil_scoped_release release;
  return std::make_shared<SurfaceSamples>(
      sample_surface(point_span, face_span, options, team, progress));
}

std::vector<Disk> disks_of(const Points& points, const Points& normals, const FloatArray& radius) {
  const auto centres = points.span(), directions = normals.span();
  const auto count = static_cast<py::ssize_t>(centres.size());
  if (directions.size() != centres.size() || radius.ndim() != 1 || radius.size() != count) {
    throw InvalidInputError("Expected one normal and one radius per point, found " +
                            std::to_string(directions.size()) + " and " +
                            std::to_string(radius.size()) + " for " + std::to_string(count) +
                            " points; pass all of them.");
  }
  require_finite(centres, "point");
  require_finite(directions, "normal");
  std::vector<Disk> disks;
  for (size_t i = 0; i < centres.size(); ++i) {
    const double r = radius.data()[i];
    if (!(r > 0 && r < HUGE_VAL)) {
      throw InvalidInputError("Expected positive radii, found " + text(r) + "; correct it.");
    }
    disks.push_back({centres[i], r, directions[i]});
  }
  return disks;
}

py::tuple close_openings(const py::object& points, const py::object& normals,
                         const FloatArray& radius, const py::object& vertices,
                         const py::object& triangles, int64_t seed, Progress* progress,
                         int threads) {
  const auto kept = disks_of(Points(points, "points"), Points(normals, "normals"), radius);
  const Points corners(vertices, "vertices");
  const Triangles faces(triangles);
  const Run run{thread_count(thread_argument(threads)), progress};
  ClosingSamples samples;
  {
    const auto corner_span = corners.span();
    const auto face_span = faces.span();
    const py::gil_scoped_release release;
    samples = closing_samples(corner_span, face_span, kept, static_cast<uint64_t>(seed), run);
  }
  return py::make_tuple(array_of<double>(std::move(samples.points)),
                        array_of<double>(std::move(samples.normals)),
                        array_of<double>(std::move(samples.radius)));
}

}  // namespace

void bind_sampling(py::module_& m) {
  py::enum_<SampleKind>(m, "SampleKind", py::module_local(), docs::SampleKind)
      .value("CORNER", SampleKind::corner, docs::SampleKind_CORNER)
      .value("SHARP", SampleKind::sharp, docs::SampleKind_SHARP)
      .value("BOUNDARY", SampleKind::boundary, docs::SampleKind_BOUNDARY)
      .value("VERTEX", SampleKind::vertex, docs::SampleKind_VERTEX)
      .value("SURFACE", SampleKind::surface, docs::SampleKind_SURFACE)
      .value("OPENING", SampleKind::opening, docs::SampleKind_OPENING);
  using S = SurfaceSamples;
  py::class_<S, std::shared_ptr<S>>(m, "SurfaceSamples", docs::SurfaceSamples, py::is_final(),
                                    py::module_local())
      .def_property_readonly("points", view_property<double>(&S::points),
                             docs::SurfaceSamples_points)
      .def_property_readonly("normals", view_property<double>(&S::normals),
                             docs::SurfaceSamples_normals)
      .def_property_readonly("triangle", view_property<int32_t>(&S::triangle),
                             docs::SurfaceSamples_triangle)
      .def_property_readonly("barycentric", view_property<double>(&S::barycentric),
                             docs::SurfaceSamples_barycentric)
      .def_property_readonly("kind", view_property<int32_t>(&S::kind), docs::SurfaceSamples_kind)
      .def_property_readonly("radius", view_property<double>(&S::radius),
                             docs::SurfaceSamples_radius)
      .def_property_readonly("partner", view_property<int32_t>(&S::partner),
                             docs::SurfaceSamples_partner)
      .def_property_readonly("bend", view_property<double>(&S::bend), docs::SurfaceSamples_bend)
      .def_property_readonly("sharp_edges", view_property<int32_t>(&S::sharp_edges),
                             docs::SurfaceSamples_sharp_edges)
      .def_readonly("area", &S::area, docs::SurfaceSamples_area);
  m.def("sample_surface", &sample, docs::sample_surface, py::arg("vertices"), py::arg("triangles"),
        py::kw_only(), py::arg("count") = py::none(), py::arg("spacing") = py::none(),
        py::arg("sizing") = py::none(), py::arg("sharp_angle") = SamplingOptions{}.sharp_angle,
        py::arg("sharp_edges") = py::none(), py::arg("smooth") = false,
        py::arg("keep_vertices") = false,
        py::arg("mirrored_rows") = SamplingOptions{}.mirrored_rows, py::arg("pairs") = false,
        py::arg("seed") = 0, py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("closing_samples", &close_openings, docs::closing_samples, py::arg("points"),
        py::arg("normals"), py::arg("radius"), py::arg("vertices"), py::arg("triangles"),
        py::kw_only(), py::arg("seed") = 0, py::arg("progress") = nullptr, py::arg("threads") = 0);
}

}  // namespace medial::python
