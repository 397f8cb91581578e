// SPDX-License-Identifier: GPL-3.0-or-later
// This binds the single stages for Python: each starts from the points and ends with ids of input
// rows.
#include "arrays.h"
#include "axis/umbrellas.h"
#include "cocone/cocone.h"
#include "delaunay/samples.h"
#include "study/study_bindings.h"
#include "study_docstrings.h"

namespace medial::python {
namespace {

Run all_cores() { return {thread_count(0), nullptr}; }

std::span<const Vec3> with_volume(std::span<const Vec3> points) {
  require_volume(points);
  return points;
}

// This runs the pipeline up to the umbrellas.
struct Stages {
  explicit Stages(std::span<const Vec3> rows)
      : samples(make_samples(rows, all_cores())),
        triangulation(triangulate(with_volume(samples.points), all_cores())),
        voronoi(medial::voronoi(samples.points, triangulation, all_cores())),
        incident(incident_cells(triangulation, samples.count(), all_cores())) {}

  std::vector<int32_t> by_row() const { return samples_by_row(samples); }
  Poles poles() const {
    return medial::poles(samples.points, triangulation, voronoi, incident, all_cores());
  }

  Samples samples;
  Triangulation triangulation;
  Voronoi voronoi;
  Csr<int32_t> incident;
};

Array<Cell> cell_rows(const Stages& stages) {
  auto rows = stages.triangulation.cells;
  for (Cell& cell : rows) {
    for (int32_t& id : cell) id = id == kInfinite ? kInfinite : stages.samples.row[id];
  }
  return rows;
}

py::tuple delaunay(const py::object& points) {
  const Points rows(points, "points");
  auto stages = [&, span = rows.span()] {
    const py::gil_scoped_release release;
    return Stages(span);
  }();
  return py::make_tuple(array_of<int32_t>(cell_rows(stages)),
                        array_of<int32_t>(std::move(stages.triangulation.neighbors)),
                        array_of<double>(std::move(stages.voronoi.centre)));
}

py::tuple pole_vectors(const py::object& points) {
  const Points rows(points, "points");
  std::vector<Vec3> vectors;
  std::vector<uint8_t> unbounded;
  {
    const auto span = rows.span();
    const py::gil_scoped_release release;
    const Stages stages(span);
    const Poles poles = stages.poles();
    for (const int32_t p : stages.by_row()) {
      vectors.push_back(poles.vector[p]);
      unbounded.push_back(poles.unbounded[p]);
    }
  }
  return py::make_tuple(array_of<double>(std::move(vectors)),
                        array_of<uint8_t>(std::move(unbounded)).attr("view")("bool"));
}

void append_rows(int32_t p, const Umbrellas& umbrellas, const Samples& samples,
                 std::vector<std::array<int32_t, 3>>& out) {
  const auto begin = static_cast<std::ptrdiff_t>(out.size());
  for (const auto& [a, b] : umbrellas[p]) {
    const auto [low, high] = std::minmax(samples.row[a], samples.row[b]);
    out.push_back({samples.row[p], low, high});
  }
  std::sort(out.begin() + begin, out.end());
}

py::tuple umbrella_triangles(const py::object& points) {
  const Points rows(points, "points");
  std::vector<int64_t> offsets{0};
  std::vector<std::array<int32_t, 3>> triangles;
  {
    const auto span = rows.span();
    const py::gil_scoped_release release;
    const Stages s(span);
    const Umbrellas found =
        umbrellas(s.samples.points, s.triangulation, s.voronoi, s.incident, all_cores());
    for (const int32_t p : s.by_row()) {
      append_rows(p, found, s.samples, triangles);
      offsets.push_back(static_cast<int64_t>(triangles.size()));
    }
  }
  return py::make_tuple(array_of<int64_t>(std::move(offsets)),
                        array_of<int32_t>(std::move(triangles)));
}

std::vector<std::array<int32_t, 3>> candidate_rows(const Stages& s, const FaceSet& candidates) {
  std::vector<std::array<int32_t, 3>> rows;
  for_faces(s.triangulation, candidates, [&](const CellFace& f) {
    if (s.triangulation.neighbors[f.cell][f.slot] < f.cell) return;
    auto triangle = corners(s.triangulation, f);
    for (int32_t& id : triangle) id = s.samples.row[id];
    std::sort(triangle.begin(), triangle.end());
    rows.push_back(triangle);
  });
  std::sort(rows.begin(), rows.end());
  return rows;
}

py::array flags_by_row(const Stages& s, const std::vector<uint8_t>& flags) {
  std::vector<uint8_t> ordered;
  for (const int32_t p : s.by_row()) ordered.push_back(flags[p]);
  return array_of<uint8_t>(std::move(ordered)).attr("view")("bool");
}

py::tuple cocone_parts(const py::object& points, const CoconeOptions* options) {
  const Points rows(points, "points");
  const CoconeOptions chosen = options ? *options : CoconeOptions{};
  const auto [stages, found] = [&, span = rows.span()] {
    const py::gil_scoped_release release;
    Stages s(span);
    Cocone c = cocone(s.samples.points, s.triangulation, s.voronoi, s.incident, s.poles(), chosen,
                      all_cores());
    return std::make_pair(std::move(s), std::move(c));
  }();
  return py::make_tuple(flags_by_row(stages, found.thin), flags_by_row(stages, found.flat),
                        array_of<int32_t>(candidate_rows(stages, found.candidates)));
}

}  // namespace

void bind_stages(py::module_& m) {
  m.def("delaunay", &delaunay, docs::delaunay, py::arg("points"));
  m.def("poles", &pole_vectors, docs::poles, py::arg("points"));
  m.def("umbrellas", &umbrella_triangles, docs::umbrellas, py::arg("points"));
  m.def("cocone", &cocone_parts, docs::cocone, py::arg("points"), py::arg("options") = py::none());
}

}  // namespace medial::python
