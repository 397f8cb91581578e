// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis_parts.h"
#include "axis/feature_size.h"
#include "axis/medial_mesh.h"
#include "base/rows.h"
#include "base/text.h"
#include "cocone/solid.h"
#include "cocone/watertight_surface.h"
#include "inside/doubts.h"
#include "inside/pockets.h"
#include "levels/hierarchy.h"
#include "thickness/thickness.h"

namespace medial {
namespace {

using Parts = MedialAnalysis::Parts;

void require_sides(const Parts& made) {
  if (made.sides_from == SidesFrom::none) {
    throw InvalidInputError(
        "Expected an analysis that told inside from outside, found one with sides NONE; choose "
        "other sides, or side BOTH.");
  }
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

std::vector<double> outward_lengths(std::vector<double> lengths, const Frame& frame) {
  for (double& length : lengths) length = frame.outward(length);
  return lengths;
}

// There is one row, or -1, per point, or none at all.
void require_partners(std::span<const int32_t> partners, size_t points) {
  if (!partners.empty())
    require_one_each(partners.size(), points, "one partner per point",
                     "points; pass all of them or none");
  for (const int32_t row : partners) {
    if (row >= -1 && row < static_cast<int64_t>(points)) continue;
    throw InvalidInputError("Expected partners from -1 to below " + std::to_string(points) +
                            ", found " + std::to_string(row) + "; pass rows of the points.");
  }
}

void require_reaches(std::span<const double> reach, size_t points) {
  require_one_each(reach.size(), points, "one reach per point", "points; pass all of them");
}

void require_valid(const FacesInput& faces, size_t points) {
  require_one_each(faces.face.size(), points, "a face per point", "points; pass -1 for none");
  const auto count = static_cast<int64_t>(faces.triangles.size());
  for (const int32_t face : faces.face) {
    if (face >= -1 && face < count) continue;
    throw InvalidInputError("Expected faces of points below " + std::to_string(count) + ", found " +
                            std::to_string(face) + "; name rows of the triangles.");
  }
}

Facets facets_of(const Parts& made, const CellSides& sides) {
  return {made.samples.points, made.triangulation, made.voronoi,
          made.edges,          made.significance,  sides};
}

}  // namespace

void require_solid(const Parts& made) {
  require_sides(made);
  const WatertightSurface* tight_cocone = made.tight_cocone.get();
  if (tight_cocone && !tight_cocone->encloses()) {
    throw DegenerateInputError(
        "Expected samples of a closed surface, found " +
        std::to_string(tight_cocone->left_outside) + " of " +
        std::to_string(tight_cocone->samples.size()) +
        " that enclose nothing; sample more densely and evenly, or choose side Both.");
  }
}

Facets facets_of(const Parts& made) { return facets_of(made, made.sides); }

std::vector<int32_t> edges_by_row(const Parts& made) {
  std::vector<int32_t> order;
  order.reserve(made.edges.ends.size());
  for (const int32_t p : samples_by_row(made.samples)) {
    for (int32_t e = made.edges.first[p]; e < made.edges.first[p + 1]; ++e) order.push_back(e);
  }
  return order;
}

void bring_outward(MedialMesh& mesh, const Frame& frame) {
  if (frame.is_plain()) return;
  for (Vec3& v : mesh.vertices) v = frame.outward(v);
  for (double& r : mesh.radius) r = frame.outward(r);
}

namespace {

Selection selection(const Parts& made, const Extraction& x) {
  const Selection selection(x, facets_of(made));
  if (x.side != Side::both) require_solid(made);
  return selection;
}

// Returns the values of the edges in the order of edges_by_row.
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

Hierarchy MedialAnalysis::hierarchy(const Thresholds& thresholds, Side side,
                                    std::optional<int64_t> bodies, Progress* progress,
                                    const FacesInput* faces, std::span<const int32_t> partners,
                                    bool places) const {
  if (side != Side::inner) {
    throw InvalidInputError(
        "Expected side INNER for a hierarchy, found another one; the outer axis reaches infinity, "
        "where fire has no rim to start from.");
  }
  require_solid(*parts_);
  if (faces) require_valid(*faces, parts_->samples.point_of_row.size());
  require_partners(partners, parts_->samples.point_of_row.size());
  const SmallParts& small = parts_->small;
  const bool has_small = !small.pockets.empty() || !small.crumbs.empty();
  CellSides in_parts;
  if (has_small) in_parts = without(small, bodies, parts_->triangulation, parts_->sides);
  const CellSides& sides = has_small ? in_parts : parts_->sides;
  return make_hierarchy(parts_->samples, facets_of(*parts_, sides), thresholds, faces, partners,
                        places, parts_->frame, parts_->run(progress));
}

std::vector<double> MedialAnalysis::theta(Rule rule) const {
  return by_row<double>(*parts_,
                        [&](int32_t e) { return theta_of(parts_->significance.sines(rule)[e]); });
}

std::vector<double> MedialAnalysis::rho(Rule rule) const {
  return by_row<double>(*parts_, [&](int32_t e) { return parts_->significance.ratios(rule)[e]; });
}

std::vector<double> MedialAnalysis::spacing() const {
  const std::span<const double> spacing = parts_->significance.spacing;
  return outward_lengths(rows_of(spacing, samples_by_row(parts_->samples)), parts_->frame);
}

std::vector<double> MedialAnalysis::feature_size(const Thresholds& thresholds,
                                                 std::optional<std::span<const int32_t>> rows,
                                                 Progress* progress) const {
  begin_stage(progress, "Feature size", 0, 1);
  const auto at = rows ? samples_of(*rows, parts_->samples) : samples_by_row(parts_->samples);
  std::vector<int32_t> all = all_rows(parts_->edges.ends.size());
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
  require_solid(*parts_);
  const size_t rows = parts_->samples.point_of_row.size();
  if (options.mode != ThicknessMode::scan) require_normals(input.normals, rows);
  if (input.at_edge)
    require_one_each(input.at_edge->size(), rows, "edges as one flag per point",
                     "points; pass all of them or none");
  begin_stage(progress, "Thickness", 0, 1);
  auto found = medial::thickness(input, options, parts_->samples, facets_of(*parts_),
                                 {parts_->threads, progress});
  found.values = outward_lengths(std::move(found.values), parts_->frame);
  advance(progress, 1);
  return found;
}

Doubts MedialAnalysis::doubts(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                              std::span<const Vec3> normals, std::span<const double> reach,
                              Progress* progress) const {
  const Samples& samples = parts_->samples;
  require_finite(vertices, "vertex");
  require_corners(triangles, vertices.size());
  require_normals(normals, samples.point_of_row.size());
  require_reaches(reach, samples.point_of_row.size());
  begin_stage(progress, "Topology", 0, 1);
  const RayCrossings surface(soup(parts_->frame.inward(vertices), triangles), progress);
  const double unit = parts_->frame.outward(1.0);
  std::vector<Vec3> normal_of;
  std::vector<double> reach_of;
  for (int32_t p = 0; p < samples.count(); ++p) {
    normal_of.push_back(normals[samples.row[p]]);
    reach_of.push_back(reach[samples.row[p]] / unit);
  }
  Doubts found;
  for (const auto& [place, gap] :
       medial::doubts({samples.points, normal_of, reach_of, parts_->triangulation, parts_->voronoi},
                      surface, parts_->run(progress))) {
    found.places.push_back(parts_->frame.outward(place));
    found.gaps.push_back(parts_->frame.outward(gap));
  }
  advance(progress, 1);
  return found;
}

std::vector<Triangle> MedialAnalysis::solid_triangles() const {
  require_sides(*parts_);
  if (parts_->tight_cocone) return parts_->tight_cocone->triangles;
  const Run run{parts_->threads, nullptr};
  CellSides sides(parts_->sides);
  // The points of a bounding sphere are not samples, and cells that touch them are outside.
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
