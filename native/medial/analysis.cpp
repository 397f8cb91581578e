// SPDX-License-Identifier: GPL-3.0-or-later
#include <numeric>

#include "analysis_parts.h"
#include "axis/feature_size.h"
#include "axis/medial_mesh.h"
#include "axis/pole_balls.h"
#include "thickness/thickness.h"
#include "cocone/labelled_poles.h"
#include "cocone/watertight_surface.h"
#include "inside/pockets.h"
#include "skeleton/hierarchy.h"

namespace medial {
namespace {

using Parts = MedialAnalysis::Parts;

void require_sides(SidesFrom from) {
  if (from == SidesFrom::none) {
    throw InvalidInputError(
        "Expected an analysis that told inside from outside, found one with sides NONE; choose "
        "other sides, or side BOTH.");
  }
}

void require_solid(SidesFrom from, const WatertightSurface* tight_cocone) {
  require_sides(from);
  if (tight_cocone && !tight_cocone->encloses()) {
    throw DegenerateInputError(
        "Expected samples of a closed surface, found " +
        std::to_string(tight_cocone->left_outside) + " of " +
        std::to_string(tight_cocone->samples.size()) +
        " that enclose nothing; sample more densely and evenly, or choose side Both.");
  }
}

// Of what follows theta and rho; other criteria only select facets.
void require_theta_or_rho(const Thresholds& thresholds) {
  if (!is_by_theta_or_rho(thresholds.criteria)) {
    throw InvalidInputError(
        "Expected criteria ANGLE_OR_RATIO, ANGLE or RATIO, found ones that only select facets; "
        "choose one of these, or extract.");
  }
}

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
  if (wanted != SidesFrom::automatic) return wanted;
  if (surface.closed()) return SidesFrom::surface;
  return has_normals ? SidesFrom::normals : SidesFrom::tight_cocone;
}

// One per row, finite, and not all zero.
void require_normals(std::span<const Vec3> normals, size_t rows) {
  if (normals.size() != rows) {
    throw InvalidInputError("Expected one normal per point, found " +
                            std::to_string(normals.size()) + " for " + std::to_string(rows) +
                            " points; pass all of them or none.");
  }
  require_finite(normals, "normal");
  if (std::all_of(normals.begin(), normals.end(), [](const Vec3& n) { return n == Vec3{}; })) {
    throw InvalidInputError(
        "Expected outward normals, found zero vectors only; pass real normals or none.");
  }
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

std::vector<int32_t> samples_of(std::span<const int32_t> rows, const Samples& samples) {
  const auto end = static_cast<int64_t>(samples.point_of_row.size());
  std::vector<int32_t> ids;
  ids.reserve(rows.size());
  for (const int32_t row : rows) {
    if (row < 0 || row >= end) {
      throw InvalidInputError("Expected rows below " + std::to_string(end) + ", found " +
                              std::to_string(row) + "; name rows of the points.");
    }
    ids.push_back(samples.point_of_row[row]);
  }
  return ids;
}

bool needs_poles(SidesFrom from) {
  return from == SidesFrom::tight_cocone || from == SidesFrom::poles;
}

// Of the surface of the solid, whose vertices are given; made while CGAL inserts points, which
// leaves the other cores idle. Without other cores it is made when it is asked for. All that it
// refers to outlives it, for it is waited for where it ends.
std::shared_future<WindingNumber> winding_number(std::span<const Vec3> vertices,
                                                 const Surface& surface, std::launch when,
                                                 const Run& run) {
  return std::async(when, [vertices, &surface, run] {
    return WindingNumber(vertices, surface.triangles, surface.boundary, run.progress);
  });
}

// `winding` is that of the surface of the solid.
void find_pockets(Parts& made, const std::shared_future<WindingNumber>& winding, const Run& run) {
  made.pockets = pockets(made.samples.points, made.significance.spacing, winding,
                         made.triangulation, made.voronoi, made.sides, run);
}

void take_tight_cocone(Parts& made, TightCocone found, const Csr<int32_t>& incident,
                       const Run& run) {
  SolidBoundary boundary = solid_boundary(made.triangulation, incident, found.sides, run);
  made.sides = sides_in_solid(made.samples.points, found.sides, boundary.triangles,
                              made.triangulation, made.voronoi, run);
  const Surface surface{boundary.triangles, {}};
  find_pockets(made, winding_number(made.samples.points, surface, std::launch::deferred, run), run);
  found.sides = {};
  made.tight_cocone = std::make_shared<WatertightSurface>(
      describe(std::move(found), std::move(boundary), made.samples, run));
}

void take_labels(Parts& made, const LabelledPoles& labelled, const Run& run) {
  made.sides = sides_from_normals(made.samples.points, labelled.normals, made.triangulation,
                                  made.voronoi, run);
  made.sides_from = SidesFrom::poles;
  made.pockets.clear();  // of Tight Cocone
  made.tight_cocone.reset();
}

// A larger share of samples whose poles lie elsewhere by Tight Cocone tells of walls that it does
// not see, such as those of cavities; noise, outliers and sharp edges stay below.
constexpr double kDisagreement = 0.05;

// By the samples alone: Tight Cocone, or labels of the poles. Automatic takes these where many
// disagree with Tight Cocone.
void tell_sides_of_poles(Parts& made, const Csr<int32_t>& incident, bool automatic,
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

void tell_sides(Parts& made, const Surface& surface, std::span<const Vec3> vertices,
                const std::shared_future<WindingNumber>& winding, std::span<const Vec3> normals,
                const Csr<int32_t>& incident, bool automatic, const CoconeOptions& options,
                const Run& run) {
  const std::vector<Vec3>& points = made.samples.points;
  if (made.sides_from == SidesFrom::surface) {
    made.sides = sides_from_surface(points, vertices, surface, winding.get(), made.triangulation,
                                    made.voronoi, run);
    find_pockets(made, winding, run);
  } else if (made.sides_from == SidesFrom::normals) {
    made.sides = sides_from_normals(points, unit_normals(normals, made.samples), made.triangulation,
                                    made.voronoi, run);
  } else if (needs_poles(made.sides_from)) {
    tell_sides_of_poles(made, incident, automatic, options, run);
  }
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

void bring_outward(MedialMesh& mesh, const Frame& frame) {
  if (frame.is_plain()) return;
  for (Vec3& v : mesh.vertices) v = frame.outward(v);
  for (double& r : mesh.radius) r = frame.outward(r);
}

std::vector<double> outward_lengths(std::vector<double> lengths, const Frame& frame) {
  for (double& length : lengths) length = frame.outward(length);
  return lengths;
}

std::unique_ptr<const Parts> analysed(const AnalysisInput& input, const AnalysisOptions& options,
                                      Progress* progress) {
  auto kept = std::make_unique<Parts>();
  Parts& made = *kept;
  made.threads = thread_count(options.threads);
  made.arena = arena_for(input.points.size());
  const Run run = made.run(progress), quiet = made.run();
  Stopwatch watch(made.timings);
  begin_stage(progress, "Samples", 0, 0.02);
  require_corners(input.triangles, input.vertices.value_or(input.points).size());
  if (input.normals) require_normals(*input.normals, input.points.size());
  const FramedInput framed(input);
  made.frame = framed.frame;
  made.samples = make_samples(framed.points, quiet);
  const int32_t count = made.samples.count();
  made.duplicates = static_cast<int64_t>(input.points.size()) - count;
  require_volume(made.samples.points);
  const Samples apart =
      framed.vertices ? distinct_rows(*framed.vertices, "vertex", quiet) : Samples{};
  const Samples& corners = framed.vertices ? apart : made.samples;
  const Surface surface =
      make_surface(input.triangles, corners.point_of_row, corners.count(), quiet);
  made.closed = surface.closed();
  made.boundary_edges = surface.open_edges();
  made.sides_from = resolve(options.sides, surface, input.normals.has_value());
  if (options.bounding_sphere) add_bounding_sphere(made.samples);
  const std::vector<Vec3>& points = made.samples.points;
  watch.lap("samples");
  const bool is_early = made.threads > 1 && made.sides_from == SidesFrom::surface;
  const auto when = is_early ? std::launch::async | std::launch::deferred : std::launch::deferred;
  const auto winding = winding_number(corners.points, surface, when, run);
  {
    // CGAL leaves the other cores idle: they have memory ready for the stages that follow.
    std::optional<ArenaToucher> toucher;
    if (made.threads > 1) toucher.emplace(*made.arena, kBytesPerPoint * points.size());
    made.triangulation = triangulate(points, run, &watch);
  }
  watch.lap("cells");
  made.voronoi = voronoi(points, made.triangulation, run);
  watch.lap("voronoi");
  begin_stage(progress, "Delaunay edges", 0.66, 0.68);
  Csr<int32_t> incident = incident_cells(made.triangulation, count, run);
  made.edges = delaunay_edges(made.triangulation, incident, made.samples.row, run);
  watch.lap("complex");
  {
    const Umbrellas u = umbrellas(points, made.triangulation, made.voronoi, incident, run);
    watch.lap("umbrellas");
    Poles vectors;
    if (options.against != Against::umbrella) {
      vectors = poles(points, made.triangulation, made.voronoi, incident, made.run());
    }
    if (!needs_poles(made.sides_from)) incident = {};
    made.significance =
        medial::significance(points, made.edges, u, run, options.against, vectors.vector);
    watch.lap("significance");
  }
  tell_sides(made, surface, corners.points, winding,
             input.normals.value_or(std::span<const Vec3>()), incident,
             options.sides == SidesFrom::automatic, options.cocone, run);
  watch.lap("sides");
  begin_stage(progress, "Inside and outside", 0.99, 1);
  advance(progress, 1);
  return kept;
}

Facets facets_of(const Parts& made, const CellSides& sides) {
  return {made.samples.points, made.triangulation, made.voronoi,
          made.edges,          made.significance,  sides};
}

Facets facets_of(const Parts& made) { return facets_of(made, made.sides); }

Selection selection(const Parts& made, const Extraction& x) {
  const Selection selection(x, facets_of(made));
  if (x.side != Side::both) require_solid(made.sides_from, made.tight_cocone.get());
  return selection;
}

// In lexicographic order of their input rows.
std::vector<int32_t> edges_by_row(const Parts& made) {
  std::vector<int32_t> order;
  order.reserve(made.edges.ends.size());
  for (const int32_t p : samples_by_row(made.samples)) {
    for (int32_t e = made.edges.first[p]; e < made.edges.first[p + 1]; ++e) order.push_back(e);
  }
  return order;
}

// Values of the edges in that order.
template <typename T, typename Value>
std::vector<T> by_row(const Parts& made, const Value& value) {
  const auto order = edges_by_row(made);
  std::vector<T> result(order.size());
  parallel_for(made.edges.count(), {made.threads}, [&](int64_t i) { result[i] = value(order[i]); });
  return result;
}

}  // namespace

MedialAnalysis::MedialAnalysis(const AnalysisInput& input, const AnalysisOptions& options,
                               Progress* progress)
    : parts_(analysed(input, options, progress)) {}
MedialAnalysis::~MedialAnalysis() = default;
MedialAnalysis::MedialAnalysis(MedialAnalysis&&) noexcept = default;
MedialAnalysis& MedialAnalysis::operator=(MedialAnalysis&&) noexcept = default;

std::vector<int32_t> MedialAnalysis::select(const Extraction& extraction,
                                            Progress* progress) const {
  return selected(selection(*parts_, extraction), edges_by_row(*parts_), parts_->run(progress));
}

MedialMesh MedialAnalysis::extract(const Extraction& extraction, Progress* progress) const {
  begin_stage(progress, "Facets", 0, 1);
  MedialMesh mesh =
      voronoi_facets(selection(*parts_, extraction), parts_->samples, parts_->triangulation,
                     parts_->voronoi, parts_->edges, parts_->run(progress));
  bring_outward(mesh, parts_->frame);
  advance(progress, 1);
  return mesh;
}

MedialMesh MedialAnalysis::poles(Side side, Progress* progress) const {
  begin_stage(progress, "Poles", 0, 1);
  const Parts& made = *parts_;
  selection(made, {.side = side});  // it throws what is wrong with the side
  const Run quiet = made.run();
  const auto incident = incident_cells(made.triangulation, made.samples.count(), quiet);
  throw_if_cancelled(progress);
  MedialMesh mesh =
      pole_balls(made.samples, made.triangulation, made.voronoi, incident, made.sides, side, quiet);
  bring_outward(mesh, made.frame);
  advance(progress, 1);
  return mesh;
}

Hierarchy MedialAnalysis::hierarchy(const Thresholds& thresholds, Side side,
                                    Progress* progress) const {
  if (side != Side::inner) {
    throw InvalidInputError(
        "Expected side INNER for a hierarchy, found another one; the outer axis reaches infinity, "
        "where fire has no rim to start from.");
  }
  require_theta_or_rho(thresholds);
  require_solid(parts_->sides_from, parts_->tight_cocone.get());
  CellSides in_parts;
  if (!parts_->pockets.empty()) in_parts = without(parts_->pockets, parts_->sides);
  const CellSides& sides = parts_->pockets.empty() ? parts_->sides : in_parts;
  return make_hierarchy(parts_->samples, facets_of(*parts_, sides), thresholds, parts_->frame,
                        parts_->run(progress));
}

std::vector<double> MedialAnalysis::theta(Rule rule) const {
  return by_row<double>(*parts_,
                        [&](int32_t e) { return theta_of(parts_->significance.sines(rule)[e]); });
}

std::vector<double> MedialAnalysis::rho(Rule rule) const {
  return by_row<double>(*parts_, [&](int32_t e) { return parts_->significance.ratios(rule)[e]; });
}

std::vector<double> MedialAnalysis::spacing() const {
  std::vector<double> result;
  result.reserve(parts_->samples.row.size());
  for (const int32_t id : samples_by_row(parts_->samples))
    result.push_back(parts_->significance.spacing[id]);
  return outward_lengths(std::move(result), parts_->frame);
}

std::vector<double> MedialAnalysis::feature_size(const Thresholds& thresholds,
                                                 std::optional<std::span<const int32_t>> rows,
                                                 Progress* progress) const {
  require_theta_or_rho(thresholds);
  begin_stage(progress, "Feature size", 0, 1);
  const auto at = rows ? samples_of(*rows, parts_->samples) : samples_by_row(parts_->samples);
  std::vector<int32_t> all(parts_->edges.ends.size());
  std::iota(all.begin(), all.end(), 0);
  const auto ids =
      selected(selection(*parts_, {.thresholds = thresholds}), all, parts_->run(progress));
  auto sizes =
      medial::feature_size(parts_->samples.points, at, parts_->triangulation, parts_->voronoi,
                           parts_->edges, ids, {parts_->threads, progress});
  advance(progress, 1);
  return outward_lengths(std::move(sizes), parts_->frame);
}

WallThickness MedialAnalysis::thickness(const ThicknessInput& input,
                                        const ThicknessOptions& options, Progress* progress) const {
  if (options.side != Side::inner && options.side != Side::outer) {
    throw InvalidInputError(
        "Expected side INNER for a thickness or OUTER for a gap, found another one; choose one of "
        "them.");
  }
  require_theta_or_rho(options.thresholds);
  require_solid(parts_->sides_from, parts_->tight_cocone.get());
  const size_t rows = parts_->samples.point_of_row.size();
  if (options.mode != ThicknessMode::scan) require_normals(input.normals, rows);
  if (input.at_edge && input.at_edge->size() != rows) {
    throw InvalidInputError("Expected edges as one flag per point, found " +
                            std::to_string(input.at_edge->size()) + " for " + std::to_string(rows) +
                            " points; pass all of them or none.");
  }
  begin_stage(progress, "Thickness", 0, 1);
  auto found = medial::thickness(input, options, parts_->samples, facets_of(*parts_),
                                 {parts_->threads, progress});
  found.values = outward_lengths(std::move(found.values), parts_->frame);
  advance(progress, 1);
  return found;
}

std::vector<Triangle> MedialAnalysis::solid_triangles() const {
  require_sides(parts_->sides_from);
  if (parts_->tight_cocone) return parts_->tight_cocone->triangles;
  const Run run{parts_->threads, nullptr};
  CellSides sides(parts_->sides);
  // The points of a bounding sphere are no samples, and what touches them lies outside.
  parallel_for(parts_->triangulation.cell_count(), run, [&](int64_t c) {
    const Cell& cell = parts_->triangulation.cells[c];
    if (*std::max_element(cell.begin(), cell.end()) >= parts_->samples.count()) {
      sides[c] = Side::outer;
    }
  });
  return in_rows(boundary_triangles(parts_->triangulation, sides, run), parts_->samples, run);
}

std::vector<Edge> MedialAnalysis::edge_rows() const {
  return by_row<Edge>(*parts_, [&](int32_t e) {
    const auto& [p, q] = parts_->edges.ends[e];
    return Edge{parts_->samples.row[p], parts_->samples.row[q]};
  });
}

std::vector<Side> MedialAnalysis::edge_sides() const {
  if (parts_->sides.empty()) return std::vector<Side>(parts_->edges.ends.size(), Side::both);
  return by_row<Side>(*parts_, [&](int32_t e) {
    thread_local std::vector<int32_t> ring;
    ring_of_cells(parts_->triangulation, parts_->edges.ends[e], parts_->edges.cell[e], ring);
    return facet_side(ring, parts_->sides);
  });
}

std::vector<uint8_t> MedialAnalysis::edges_bounded() const {
  return by_row<uint8_t>(*parts_, [&](int32_t e) {
    return !parts_->triangulation.is_infinite(parts_->edges.cell[e]);
  });
}

size_t MedialAnalysis::bytes() const {
  const size_t of_samples =
      parts_->samples.points.capacity() * sizeof(Vec3) +
      (parts_->samples.row.capacity() + parts_->samples.point_of_row.capacity()) * 4;
  return parts_->arena->held() + of_samples + parts_->sides.capacity();
}

std::vector<int32_t> MedialAnalysis::sample_rows() const {
  std::vector<int32_t> rows = samples_by_row(parts_->samples);
  for (int32_t& id : rows) id = parts_->samples.row[id];
  return rows;
}

int64_t MedialAnalysis::duplicates() const { return parts_->duplicates; }
int64_t MedialAnalysis::finite_cells() const { return parts_->triangulation.finite_cells; }
bool MedialAnalysis::closed() const { return parts_->closed; }
int64_t MedialAnalysis::boundary_edges() const { return parts_->boundary_edges; }
SidesFrom MedialAnalysis::sides_from() const { return parts_->sides_from; }
std::optional<double> MedialAnalysis::pole_disagreement() const {
  return parts_->pole_disagreement;
}
const std::shared_ptr<const WatertightSurface>& MedialAnalysis::tight_cocone() const {
  return parts_->tight_cocone;
}
const Timings& MedialAnalysis::timings() const { return parts_->timings; }

}  // namespace medial
