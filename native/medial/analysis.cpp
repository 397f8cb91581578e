#include "analysis.h"

#include <numeric>

namespace medial {
namespace {

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

}  // namespace

MedialAnalysis::MedialAnalysis(const AnalysisInput& input, const AnalysisOptions& options,
                               Progress* progress)
    : threads_(thread_count(options.threads)), arena_(arena_for(input.points.size())) {
  const Run run{threads_, progress, arena_.get()}, quiet{threads_, nullptr, arena_.get()};
  Stopwatch watch(timings_);
  begin_stage(progress, "Samples", 0, 0.02);
  require_corners(input.triangles, input.vertices.value_or(input.points).size());
  if (input.normals) require_normals(*input.normals, input.points.size());
  samples_ = make_samples(input.points, quiet);
  const int32_t count = samples_.count();
  duplicates_ = static_cast<int64_t>(input.points.size()) - count;
  require_volume(samples_.points);
  const Samples apart =
      input.vertices ? distinct_rows(*input.vertices, "vertex", quiet) : Samples{};
  const Samples& corners = input.vertices ? apart : samples_;
  const Surface surface =
      make_surface(input.triangles, corners.point_of_row, corners.count(), quiet);
  closed_ = surface.closed();
  boundary_edges_ = surface.open_edges();
  sides_from_ = resolve(options.sides, surface, input.normals.has_value());
  if (options.bounding_sphere) add_bounding_sphere(samples_);
  const std::vector<Vec3>& points = samples_.points;
  watch.lap("samples");
  {
    // CGAL leaves the other cores idle: they have memory ready for the stages that follow.
    std::optional<ArenaToucher> toucher;
    if (threads_ > 1) toucher.emplace(*arena_, kBytesPerPoint * points.size());
    triangulation_ = triangulate(points, run, &watch);
  }
  watch.lap("cells");
  voronoi_ = voronoi(points, triangulation_, run);
  watch.lap("voronoi");
  begin_stage(progress, "Delaunay edges", 0.66, 0.68);
  Csr<int32_t> incident = incident_cells(triangulation_, count, run);
  edges_ = delaunay_edges(triangulation_, incident, samples_.row, run);
  watch.lap("complex");
  {
    const Umbrellas u = umbrellas(points, triangulation_, voronoi_, incident, run);
    watch.lap("umbrellas");
    if (sides_from_ != SidesFrom::tight_cocone) incident = {};
    significance_ = medial::significance(points, edges_, u, run);
    watch.lap("significance");
  }
  tell_sides(surface, corners.points, input.normals.value_or(std::span<const Vec3>()), incident,
             options.cocone, run);
  watch.lap("sides");
  begin_stage(progress, "Inside and outside", 0.99, 1);
  advance(progress, 1);
}

void MedialAnalysis::tell_sides(const Surface& surface, std::span<const Vec3> vertices,
                                std::span<const Vec3> normals, const Csr<int32_t>& incident,
                                const CoconeOptions& options, const Run& run) {
  const std::vector<Vec3>& points = samples_.points;
  if (sides_from_ == SidesFrom::surface) {
    sides_ = sides_from_surface(points, vertices, surface, triangulation_, voronoi_, run);
  } else if (sides_from_ == SidesFrom::normals) {
    sides_ =
        sides_from_normals(points, unit_normals(normals, samples_), triangulation_, voronoi_, run);
  } else if (sides_from_ == SidesFrom::tight_cocone) {
    const Poles p = poles(points, triangulation_, voronoi_, incident, run);
    TightCocone found =
        medial::tight_cocone(points, triangulation_, voronoi_, incident, p, options, run);
    SolidBoundary boundary = solid_boundary(triangulation_, incident, found.sides, run);
    sides_ = sides_in_solid(points, found.sides, boundary.triangles, triangulation_, voronoi_, run);
    found.sides = {};
    tight_cocone_ = std::make_shared<WatertightSurface>(
        describe(std::move(found), std::move(boundary), samples_, run));
  }
}

Selection MedialAnalysis::selection(const Extraction& x) const {
  const Selection selection(
      x, {samples_.points, triangulation_, voronoi_, edges_, significance_, sides_});
  if (x.side != Side::both) require_solid(sides_from_, tight_cocone_.get());
  return selection;
}

std::vector<int32_t> MedialAnalysis::select(const Extraction& x, Progress* progress) const {
  return selected(selection(x), edges_by_row(), {threads_, progress, arena_.get()});
}

MedialMesh MedialAnalysis::extract(const Extraction& x, Progress* progress) const {
  begin_stage(progress, "Facets", 0, 1);
  MedialMesh mesh = voronoi_facets(selection(x), samples_, triangulation_, voronoi_, edges_,
                                   {threads_, progress, arena_.get()});
  advance(progress, 1);
  return mesh;
}

template <typename T, typename Value>
std::vector<T> MedialAnalysis::by_row(const Value& value) const {
  const auto order = edges_by_row();
  std::vector<T> result(order.size());
  parallel_for(edges_.count(), {threads_}, [&](int64_t i) { result[i] = value(order[i]); });
  return result;
}

std::vector<int32_t> MedialAnalysis::edges_by_row() const {
  std::vector<int32_t> order;
  order.reserve(edges_.ends.size());
  for (const int32_t p : samples_by_row(samples_)) {
    for (int32_t e = edges_.first[p]; e < edges_.first[p + 1]; ++e) order.push_back(e);
  }
  return order;
}

std::vector<double> MedialAnalysis::theta(Rule rule) const {
  return by_row<double>([&](int32_t e) { return theta_of(significance_.sines(rule)[e]); });
}

std::vector<double> MedialAnalysis::rho(Rule rule) const {
  return by_row<double>([&](int32_t e) { return significance_.ratios(rule)[e]; });
}

std::vector<double> MedialAnalysis::spacing() const {
  std::vector<double> result;
  result.reserve(samples_.row.size());
  for (const int32_t id : samples_by_row(samples_)) result.push_back(significance_.spacing[id]);
  return result;
}

std::vector<double> MedialAnalysis::feature_size(const Thresholds& thresholds,
                                                 std::optional<std::span<const int32_t>> rows,
                                                 Progress* progress) const {
  begin_stage(progress, "Feature size", 0, 1);
  const auto at = rows ? samples_of(*rows, samples_) : samples_by_row(samples_);
  std::vector<int32_t> all(edges_.ends.size());
  std::iota(all.begin(), all.end(), 0);
  const auto ids =
      selected(selection({.thresholds = thresholds}), all, {threads_, progress, arena_.get()});
  auto sizes = medial::feature_size(samples_.points, at, triangulation_, voronoi_, edges_, ids,
                                    {threads_, progress});
  advance(progress, 1);
  return sizes;
}

std::vector<Triangle> MedialAnalysis::solid_triangles() const {
  require_sides(sides_from_);
  if (tight_cocone_) return tight_cocone_->triangles;
  const Run run{threads_, nullptr};
  CellSides sides(sides_);
  // The points of a bounding sphere are no samples, and what touches them lies outside.
  parallel_for(triangulation_.cell_count(), run, [&](int64_t c) {
    const Cell& cell = triangulation_.cells[c];
    if (*std::max_element(cell.begin(), cell.end()) >= samples_.count()) {
      sides[c] = Side::outer;
    }
  });
  return in_rows(boundary_triangles(triangulation_, sides, run), samples_, run);
}

std::vector<Edge> MedialAnalysis::edge_rows() const {
  return by_row<Edge>([&](int32_t e) {
    const auto& [p, q] = edges_.ends[e];
    return Edge{samples_.row[p], samples_.row[q]};
  });
}

std::vector<Side> MedialAnalysis::edge_sides() const {
  if (sides_.empty()) return std::vector<Side>(edges_.ends.size(), Side::both);
  return by_row<Side>([&](int32_t e) {
    thread_local std::vector<int32_t> ring;
    ring_of_cells(triangulation_, edges_.ends[e], edges_.cell[e], ring);
    return facet_side(ring, sides_);
  });
}

std::vector<uint8_t> MedialAnalysis::edges_bounded() const {
  return by_row<uint8_t>([&](int32_t e) { return !triangulation_.is_infinite(edges_.cell[e]); });
}

size_t MedialAnalysis::bytes() const {
  const size_t of_samples = samples_.points.capacity() * sizeof(Vec3) +
                            (samples_.row.capacity() + samples_.point_of_row.capacity()) * 4;
  return arena_->held() + of_samples + sides_.capacity();
}

std::vector<int32_t> MedialAnalysis::sample_rows() const {
  std::vector<int32_t> rows = samples_by_row(samples_);
  for (int32_t& id : rows) id = samples_.row[id];
  return rows;
}

}  // namespace medial
