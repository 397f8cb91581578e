// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of an analysis, one after the other.
#include "analysis_parts.h"
#include "base/text.h"
#include "cocone/labelled_poles.h"
#include "cocone/watertight_surface.h"

namespace medial {
namespace {

using Parts = MedialAnalysis::Parts;

SidesFrom resolve(SidesFrom wanted, const Surface& surface, bool has_normals) {
  if (wanted == SidesFrom::surface && surface.triangles.empty()) {
    throw InvalidInputError(
        "Expected triangles for sides SURFACE, found none; pass the faces, or choose "
        "TIGHT_COCONE.");
  }
  if (wanted == SidesFrom::normals && !has_normals) {
    throw InvalidInputError(
        "Expected normals for sides NORMALS, found none; pass them, or choose TIGHT_COCONE.");
  }
  return wanted == SidesFrom::automatic ? automatic_sides(surface.closed(), has_normals) : wanted;
}

std::vector<Vec3> unit_normals(std::span<const Vec3> normals, const Samples& samples) {
  std::vector<Vec3> result;
  result.reserve(samples.row.size());
  for (const int32_t row : samples.row) result.push_back(normalized(normals[row]));
  return result;
}

constexpr size_t kBytesPerPoint = 900;  // samples of surfaces take at least as much

std::unique_ptr<Arena> arena_for(size_t points) {
  return std::make_unique<Arena>(2 * kBytesPerPoint * points);
}

bool needs_poles(SidesFrom from) {
  return from == SidesFrom::tight_cocone || from == SidesFrom::poles;
}

// The winding number of the surface of the solid, whose vertices are given. It is made while CGAL
// inserts points, which leaves the other cores idle; without other cores, when it is first read.
// All that it refers to outlives it, for its end is waited for.
std::shared_future<WindingNumber> winding_number(std::span<const Vec3> vertices,
                                                 const Surface& surface, std::launch when,
                                                 const Run& run) {
  return std::async(when, [vertices, &surface, run] {
    return WindingNumber(vertices, surface.triangles, surface.boundary, run.progress);
  });
}

void find_small_parts(Parts& made, const std::shared_future<WindingNumber>& winding,
                      const Run& run) {
  made.small = small_parts(made.samples.points, made.significance.spacing, winding,
                           made.triangulation, made.voronoi, made.sides, run);
}

void take_tight_cocone(Parts& made, TightCocone found, const Csr<int32_t>& incident,
                       const Run& run) {
  SolidBoundary boundary = solid_boundary(made.triangulation, incident, found.sides, run);
  made.sides = sides_in_solid(made.samples.points, found.sides, boundary.triangles,
                              made.triangulation, made.voronoi, run);
  const Surface surface{boundary.triangles, {}};
  find_small_parts(made, winding_number(made.samples.points, surface, std::launch::deferred, run),
                   run);
  found.sides = {};
  made.tight_cocone = std::make_shared<WatertightSurface>(
      describe(std::move(found), std::move(boundary), made.samples, run));
}

void take_labels(Parts& made, const LabelledPoles& labelled, const Run& run) {
  made.sides = sides_from_normals(made.samples.points, labelled.normals, made.triangulation,
                                  made.voronoi, run);
  made.sides_from = SidesFrom::poles;
  made.small = {};  // of Tight Cocone
  made.tight_cocone.reset();
}

// Where the poles of a larger share of the samples lie elsewhere by Tight Cocone, it misses walls,
// such as those of cavities. Noise, outliers and sharp edges stay below.
constexpr double kDisagreement = 0.05;  // measured: lab/quality_inside.md, disagreement

// Finds inside and outside by the samples alone: by Tight Cocone, or by labels of the poles.
// Automatic takes the labels where many disagree with Tight Cocone.
void find_sides_by_poles(Parts& made, const Csr<int32_t>& incident, bool automatic,
                         const CoconeOptions& options, const Run& run) {
  const std::vector<Vec3>& points = made.samples.points;
  const Poles p = poles(points, made.triangulation, made.voronoi, incident, run);
  const auto labelled = [&](std::span<const uint8_t> flat) {
    return labelled_poles(points, made.triangulation, made.voronoi, incident, made.edges, p, flat,
                          run);
  };
  if (made.sides_from == SidesFrom::poles) {
    const Cocone found =
        cocone(points, made.triangulation, made.voronoi, incident, p, options, run);
    return take_labels(made, labelled(found.flat), run);
  }
  TightCocone found =
      tight_cocone(points, made.triangulation, made.voronoi, incident, p, options, run);
  const std::vector<uint8_t> flat = found.flat;
  take_tight_cocone(made, std::move(found), incident, run);
  if (!automatic) return;
  const LabelledPoles labels = labelled(flat);
  made.pole_disagreement = disagreement(labels, made.sides);
  if (*made.pole_disagreement > kDisagreement) take_labels(made, labels, run);
}

// The input in the frame in which it is analysed. Where that is the plain one, nothing is copied.
class FramedInput {
 public:
  explicit FramedInput(const AnalysisInput& input) : points(input.points) {
    require_finite(input.points, "point");
    if (input.vertices) require_finite(*input.vertices, "vertex");
    require_extent(input.points);
    vertices = input.vertices;
    frame = frame_of(points, vertices.value_or(std::span<const Vec3>()));
    if (frame.is_plain()) return;
    points = own_points_ = frame.inward(points);
    if (vertices) vertices = own_vertices_ = frame.inward(*vertices);
  }
  FramedInput(const FramedInput&) = delete;

  Frame frame;
  std::span<const Vec3> points;
  std::optional<std::span<const Vec3>> vertices;

 private:
  std::vector<Vec3> own_points_, own_vertices_;
};

// Keeps what the stages share until they are done.
class Stages {
 public:
  Stages(const AnalysisInput& input, const AnalysisOptions& options, Progress* progress)
      : input_(input),
        options_(options),
        made_(*kept_),
        run_(start(progress)),
        watch_(made_.timings) {}

  std::unique_ptr<const Parts> result() {
    read_samples();
    read_surface();
    watch_.lap("samples");
    make_cells();
    measure_edges();
    find_sides();
    begin_stage(run_.progress, "Inside and outside", 0.99, 1);
    advance(run_.progress, 1);
    return std::move(kept_);
  }

 private:
  Run start(Progress* progress) {
    made_.threads = thread_count(options_.threads);
    made_.arena = arena_for(input_.points.size());
    begin_stage(progress, "Samples", 0, 0.02);
    return made_.run(progress);
  }

  void read_samples() {
    require_corners(input_.triangles, input_.vertices.value_or(input_.points).size());
    if (input_.normals) require_normals(*input_.normals, input_.points.size());
    framed_.emplace(input_);
    made_.frame = framed_->frame;
    made_.samples = make_samples(framed_->points, made_.run());
    made_.duplicates = static_cast<int64_t>(input_.points.size()) - made_.samples.count();
    require_volume(made_.samples.points);
  }

  void read_surface() {
    if (framed_->vertices) own_corners_ = distinct_rows(*framed_->vertices, "vertex", made_.run());
    surface_ =
        make_surface(input_.triangles, corners().point_of_row, corners().count(), made_.run());
    made_.closed = surface_.closed();
    made_.boundary_edges = surface_.open_edges();
    made_.sides_from = resolve(options_.sides, surface_, input_.normals.has_value());
    if (options_.bounding_sphere) add_bounding_sphere(made_.samples);
  }

  void make_cells() {
    const std::vector<Vec3>& points = made_.samples.points;
    const bool is_early = made_.threads > 1 && made_.sides_from == SidesFrom::surface;
    const auto when = is_early ? std::launch::async | std::launch::deferred : std::launch::deferred;
    winding_ = winding_number(corners().points, surface_, when, run_);
    {
      // CGAL leaves the other cores idle: they have memory ready for the stages that follow.
      std::optional<ArenaToucher> toucher;
      if (made_.threads > 1) toucher.emplace(*made_.arena, kBytesPerPoint * points.size());
      made_.triangulation = triangulate(points, run_, &watch_);
    }
    watch_.lap("cells");
    made_.voronoi = voronoi(points, made_.triangulation, run_);
    watch_.lap("voronoi");
  }

  void measure_edges() {
    const std::vector<Vec3>& points = made_.samples.points;
    begin_stage(run_.progress, "Delaunay edges", 0.66, 0.68);
    incident_ = incident_cells(made_.triangulation, made_.samples.count(), run_);
    made_.edges = delaunay_edges(made_.triangulation, incident_, made_.samples.row, run_);
    watch_.lap("complex");
    const Umbrellas u = umbrellas(points, made_.triangulation, made_.voronoi, incident_, run_);
    watch_.lap("umbrellas");
    if (!needs_poles(made_.sides_from)) incident_ = {};
    made_.significance = significance(points, made_.edges, u, run_);
    watch_.lap("significance");
  }

  void find_sides() {
    const std::vector<Vec3>& points = made_.samples.points;
    if (made_.sides_from == SidesFrom::surface) {
      made_.sides = sides_from_surface(points, corners().points, surface_, winding_.get(),
                                       made_.triangulation, made_.voronoi, run_);
      find_small_parts(made_, winding_, run_);
    } else if (made_.sides_from == SidesFrom::normals) {
      made_.sides = sides_from_normals(points, unit_normals(*input_.normals, made_.samples),
                                       made_.triangulation, made_.voronoi, run_);
    } else if (needs_poles(made_.sides_from)) {
      find_sides_by_poles(made_, incident_, options_.sides == SidesFrom::automatic, options_.cocone,
                          run_);
    }
    watch_.lap("sides");
  }

  const Samples& corners() const { return framed_->vertices ? own_corners_ : made_.samples; }

  const AnalysisInput& input_;
  const AnalysisOptions& options_;
  std::unique_ptr<Parts> kept_ = std::make_unique<Parts>();
  Parts& made_;
  Run run_;
  Stopwatch watch_;
  std::optional<FramedInput> framed_;
  Samples own_corners_;
  Surface surface_;  // of the triangles
  Csr<int32_t> incident_;
  std::shared_future<WindingNumber> winding_;  // goes before all that it refers to
};

}  // namespace

// One per row, finite, and not all zero.
void require_normals(std::span<const Vec3> normals, size_t rows) {
  require_one_each(normals.size(), rows, "one normal per point",
                   "points; pass all of them or none");
  require_finite(normals, "normal");
  if (std::all_of(normals.begin(), normals.end(), [](const Vec3& n) { return n == Vec3{}; })) {
    throw InvalidInputError(
        "Expected outward normals, found zero vectors only; pass real normals or none.");
  }
}

std::unique_ptr<const Parts> analysed(const AnalysisInput& input, const AnalysisOptions& options,
                                      Progress* progress) {
  return Stages(input, options, progress).result();
}

}  // namespace medial
