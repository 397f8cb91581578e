// SPDX-License-Identifier: GPL-3.0-or-later
// sample_surface for Python.
#include <medial/sampling.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/rows.h"
#include "base/text.h"
#include "bindings.h"
#include "sampling/closing_samples.h"

namespace medial::python {
namespace {

constexpr const char* kSamplesDoc =
    "Samples of a triangulated surface, as made by `sample_surface`: corners first, then along "
    "sharp edges, along\nboundary edges, kept vertices, and the surface.";

constexpr const char* kSampleDoc =
    "Blue-noise samples of a triangulated surface, its corners and sharp edges among them.\n\n"
    "One of `count`, `spacing` and `sizing` says how dense; `count` with `sizing` is the most that "
    "is allowed. The\nfull description stands in _medial.pyi.\n\n"
    "Parameters\n----------\n"
    "vertices : (v, 3) float64\ntriangles : (m, 3) int32\n    Rows of vertices, outward.\n"
    "count : int, optional\nspacing : float, optional\n"
    "sizing : ((k, 3) float64, (k,) float64), optional\n    Sites and the spacings there.\n"
    "sharp_angle : float\n    Radians; default pi/6.\n"
    "sharp_edges : (e, 2) int32, optional\nsmooth : bool\nkeep_vertices : bool\n"
    "mirrored_rows : int\n    Beside each sharp edge; default 2.\nseed : int\n"
    "progress : Progress, optional\nthreads : int\n\n"
    "Raises\n------\nInvalidInputError, Cancelled";

constexpr const char* kClosingDoc =
    "Samples that close the openings of a surface: blue noise where the winding number is 1/2, off "
    "the triangles.\n\n"
    "Parameters\n----------\n"
    "points : (n, 3) float64\n    Samples of the surface that bound its solid.\n"
    "normals : (n, 3) float64\nradius : (n,) float64\n    Of their discs.\n"
    "vertices : (v, 3) float64\ntriangles : (m, 3) int32\nseed : int\n"
    "progress : Progress, optional\nthreads : int\n\n"
    "Returns\n-------\npoints : (k, 3) float64\nnormals : (k, 3) float64\nradius : (k,) "
    "float64\n\n"
    "Raises\n------\nInvalidInputError, Cancelled";

using FloatArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
using IntArray = py::array_t<int32_t, py::array::c_style | py::array::forcecast>;

// Sites and their spacings; keeps what the options look at.
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

IntArray marked_rows(const py::object& object) {
  if (object.is_none()) return IntArray(std::vector<py::ssize_t>{0, 2});
  const py::array view = checked_rows(object, "sharp_edges", 2, "iu", "an (e, 2) int32 array");
  if (view.size() > 0 && !py::isinstance<py::array_t<int32_t>>(view)) {
    const auto low = view.attr("min")().cast<long long>();
    const auto high = view.attr("max")().cast<long long>();
    if (low < 0 || high > INT_MAX) {
      throw InvalidInputError("Expected rows of sharp_edges that fit an int32, found " +
                              std::to_string(low < 0 ? low : high) + "; mark the edges again.");
    }
  }
  return IntArray::ensure(view);
}

std::shared_ptr<SurfaceSamples> sample(const py::object& vertices, const py::object& triangles,
                                       std::optional<int64_t> count, std::optional<double> spacing,
                                       const py::object& sizing, double sharp_angle,
                                       const py::object& sharp_edges, bool smooth,
                                       bool keep_vertices, int mirrored_rows, int64_t seed,
                                       Progress* progress, int threads) {
  const Points points(vertices, "vertices");
  const Triangles faces(py::reinterpret_borrow<py::object>(triangles));
  const Sizing sizes(sizing);
  const IntArray marked = marked_rows(sharp_edges);
  SamplingOptions options;
  options.count = count;
  options.spacing = spacing;
  sizes.put_into(options);
  options.sharp_angle = sharp_angle;
  options.sharp_edges = {reinterpret_cast<const Edge*>(marked.data()),
                         static_cast<size_t>(marked.shape(0))};
  options.smooth = smooth;
  options.keep_vertices = keep_vertices;
  options.mirrored_rows = mirrored_rows;
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
  py::enum_<SampleKind>(m, "SampleKind", py::module_local(), "What a sample lies on.")
      .value("CORNER", SampleKind::corner)
      .value("SHARP", SampleKind::sharp)
      .value("BOUNDARY", SampleKind::boundary)
      .value("VERTEX", SampleKind::vertex)
      .value("SURFACE", SampleKind::surface)
      .value("OPENING", SampleKind::opening);
  using S = SurfaceSamples;
  py::class_<S, std::shared_ptr<S>>(m, "SurfaceSamples", kSamplesDoc, py::is_final(),
                                    py::module_local())
      .def_property_readonly("points", view_property<double>(&S::points),
                             "(n, 3) float64: the samples.")
      .def_property_readonly("normals", view_property<double>(&S::normals),
                             "(n, 3) float64: outward unit normals; where sides meet their mean; "
                             "zero where there is none.")
      .def_property_readonly("triangle", view_property<int32_t>(&S::triangle),
                             "(n,) int32: row of the triangle that the sample lies on.")
      .def_property_readonly("barycentric", view_property<double>(&S::barycentric),
                             "(n, 3) float64: where on its triangle.")
      .def_property_readonly("kind", view_property<int32_t>(&S::kind),
                             "(n,) int32: values of `SampleKind`, ascending.")
      .def_property_readonly("radius", view_property<double>(&S::radius),
                             "(n,) float64: radius of the sample's disc.")
      .def_property_readonly("sharp_edges", view_property<int32_t>(&S::sharp_edges),
                             "(e, 2) int32: rows p < q of the ends of the sharp edges, sorted.")
      .def_readonly("area", &S::area, "Area of the sampled surface.");
  m.def("sample_surface", &sample, kSampleDoc, py::arg("vertices"), py::arg("triangles"),
        py::kw_only(), py::arg("count") = py::none(), py::arg("spacing") = py::none(),
        py::arg("sizing") = py::none(), py::arg("sharp_angle") = SamplingOptions{}.sharp_angle,
        py::arg("sharp_edges") = py::none(), py::arg("smooth") = false,
        py::arg("keep_vertices") = false,
        py::arg("mirrored_rows") = SamplingOptions{}.mirrored_rows, py::arg("seed") = 0,
        py::arg("progress") = nullptr, py::arg("threads") = 0);
  m.def("closing_samples", &close_openings, kClosingDoc, py::arg("points"), py::arg("normals"),
        py::arg("radius"), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
        py::arg("seed") = 0, py::arg("progress") = nullptr, py::arg("threads") = 0);
}

}  // namespace medial::python
