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
  const py::gil_scoped_release release;
  return std::make_shared<SurfaceSamples>(
      sample_surface(points.span(), faces.span(), options, team, progress));
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
  ClosingSamples samples = released([&] {
    return closing_samples(corners.span(), faces.span(), kept, static_cast<uint64_t>(seed), run);
  });
  return arrays_of(std::move(samples.points), std::move(samples.normals),
                   std::move(samples.radius));
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
  py::class_<S, std::shared_ptr<S>> c(m, "SurfaceSamples", docs::SurfaceSamples, py::is_final(),
                                      py::module_local());
  add_view(c, "points", &S::points, docs::SurfaceSamples_points);
  add_view(c, "normals", &S::normals, docs::SurfaceSamples_normals);
  add_view(c, "triangle", &S::triangle, docs::SurfaceSamples_triangle);
  add_view(c, "barycentric", &S::barycentric, docs::SurfaceSamples_barycentric);
  add_view(c, "kind", &S::kind, docs::SurfaceSamples_kind);
  add_view(c, "radius", &S::radius, docs::SurfaceSamples_radius);
  add_view(c, "partner", &S::partner, docs::SurfaceSamples_partner);
  add_view(c, "bend", &S::bend, docs::SurfaceSamples_bend);
  add_view(c, "sharp_edges", &S::sharp_edges, docs::SurfaceSamples_sharp_edges);
  c.def_readonly("area", &S::area, docs::SurfaceSamples_area);
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
