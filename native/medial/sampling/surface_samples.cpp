// SPDX-License-Identifier: GPL-3.0-or-later
#include <medial/sampling.h>

#include <climits>
#include <numbers>

#include "base/rows.h"
#include "base/text.h"
#include "sampling/mirrored_rows.h"
#include "sampling/paired_samples.h"
#include "sampling/poisson_disk.h"

namespace medial {
namespace {

constexpr int kDarts = 14;
constexpr int64_t kMostSamples = INT_MAX / 8;  // as many as an analysis accepts
constexpr int kMostCuts = 3;                   // cuts of a curved triangle
constexpr size_t kManyPieces = 1 << 20;
constexpr int kCurveSteps = 8;  // steps along a curved edge
constexpr int kMostRows = 100;

// Holds the surface and all data that do not depend on the spacing.
struct Model {
  Model(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
        const SamplingOptions& options, const Run& run);
  // The curved surface refers to the mesh in the same object.
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  TriangleMesh mesh;
  Creases creases;
  std::optional<CurvedSurface> surface;
  std::optional<OppositeWalls> walls;  // if samples are paired
  double area = 0;
};

double area_of(const CurvedSurface& surface, const Run& run) {
  int cuts = 0;
  for (size_t pieces = surface.mesh().triangles.size(); surface.smooth() && cuts < kMostCuts;
       ++cuts) {
    if ((pieces *= 4) > kManyPieces) break;
  }
  double area = 0;
  for (const Piece& piece : cut_into_pieces(surface, cuts, {}, run)) area += piece.area;
  return area;
}

Model::Model(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
             const SamplingOptions& options, const Run& run)
    : mesh(make_mesh(vertices, triangles, run)),
      creases(find_creases(mesh, options.sharp_angle,
                           marked_edges(vertices, options.sharp_edges, mesh, triangles),
                           options.keep_vertices, run)) {
  surface.emplace(mesh, creases, options.smooth, run);
  if (options.pairs) walls.emplace(*surface, creases);
  area = area_of(*surface, run);
  if (!(area > 0)) {
    throw InvalidInputError("Expected triangles with an area, found " +
                            std::to_string(triangles.size()) +
                            " without; choose an object with faces.");
  }
}

// Holds a chain as a polyline, with its length in spacings up to each point.
struct Polyline {
  struct Knot {
    int32_t edge;
    double share;  // from the edge's first end
    double passed;
  };
  std::vector<Knot> knots;  // two per step
};

int steps_of(const Model& model, const MeshEdge& edge, const Spacing& spacing) {
  const Vec3 &p = model.mesh.points[edge.ends[0]], &q = model.mesh.points[edge.ends[1]];
  const double spacings = distance(p, q) / spacing(0.5 * p + 0.5 * q);
  const double least = model.surface->smooth() ? kCurveSteps : 1;
  return static_cast<int>(std::clamp(std::ceil(spacings), least, 65536.0));
}

// Measures a chain step by step.
class Measuring {
 public:
  Measuring(const Model& model, const Spacing& spacing)
      : model_(model), spacing_(spacing), halves_(model.walls && spacing.field) {}

  void add_edge(const ChainLink& link) {
    const MeshEdge& edge = model_.creases.edges[link.edge];
    const int steps = steps_of(model_, edge, spacing_);
    Stop before;
    for (int i = 0; i <= steps; ++i) {
      const double walked = static_cast<double>(i) / steps;
      const Stop here = stop(edge, link.reversed ? 1 - walked : walked);
      if (i > 0) add_step(link.edge, before, here, 0);
      if (i == 0) line_.knots.push_back({link.edge, here.share, passed_});
      before = here;
    }
  }
  Polyline line() && { return std::move(line_); }

 private:
  struct Stop {
    double share = 0;
    Vec3 point;
  };

  Stop stop(const MeshEdge& edge, double share) const {
    const int32_t triangle = edge.triangles[0];
    const Triangle& corners = model_.mesh.triangles[triangle];
    return {share, model_.surface->point(triangle, place_on_edge(corners, edge.ends, share))};
  }

  // Adds a step of an edge. A step that is longer than the spacing in its middle is halved: a field
  // may have far smaller spacings next to it, and samples in pairs must follow them. As spacings
  // grow slowly, those along a step that is no longer differ little.
  void add_step(int32_t edge, const Stop& from, const Stop& to, int halvings) {
    const double way = distance(from.point, to.point);
    const double apart = spacing_(0.5 * from.point + 0.5 * to.point);
    if (halves_ && way > apart && halvings < kMostHalvings) {
      const Stop middle = stop(model_.creases.edges[edge], 0.5 * (from.share + to.share));
      add_step(edge, from, middle, halvings + 1);
      add_step(edge, middle, to, halvings + 1);
      return;
    }
    passed_ += way / apart;
    line_.knots.push_back({edge, to.share, passed_});
  }

  static constexpr int kMostHalvings = 24;

  const Model& model_;
  const Spacing& spacing_;
  const bool halves_;
  double passed_ = 0;
  Polyline line_;
};

Polyline measured(const Model& model, std::span<const ChainLink> chain, const Spacing& spacing) {
  Measuring measuring(model, spacing);
  for (const ChainLink& link : chain) measuring.add_edge(link);
  return std::move(measuring).line();
}

bool begins_at_corner(const Model& model, std::span<const ChainLink> chain, bool keep_vertices) {
  const MeshEdge& edge = model.creases.edges[chain.front().edge];
  return keep_vertices || model.creases.corner[edge.ends[chain.front().reversed]];
}

struct PlaceOnEdge {
  int32_t edge;
  double share;  // from the edge's first end
};

// Divides a chain into equal parts of at most one spacing.
class Division {
 public:
  Division(const Model& model, std::span<const ChainLink> chain, bool keep_vertices,
           const Spacing& spacing)
      : line_(measured(model, chain, spacing)),
        closed_(!begins_at_corner(model, chain, keep_vertices)) {
    // tolerance for a length that is a multiple of the spacing
    constexpr double kNearlyWhole = 1e-9;  // derived: rounding
    const double least = closed_ ? 3 : 1, total = line_.knots.back().passed;
    parts_ = std::max(least, std::ceil(total * (1 - kNearlyWhole)));
    if (!(parts_ < kMostSamples)) parts_ = 0;  // the caller has counted the samples
  }

  // Returns the ends of the parts, without the ends of the chain if these are corners.
  std::vector<PlaceOnEdge> ends_of_parts() const { return places(closed_ ? 0 : 1); }
  std::vector<PlaceOnEdge> middles_of_parts() const { return places(0.5); }

 private:
  std::vector<PlaceOnEdge> places(double first) const {
    std::vector<PlaceOnEdge> found;
    size_t next = 1;
    for (double i = first; i < parts_; ++i) {
      const double wanted = line_.knots.back().passed * i / parts_;
      while (next + 1 < line_.knots.size() && line_.knots[next].passed < wanted) ++next;
      const auto &from = line_.knots[next - 1], &to = line_.knots[next];
      const double step = to.passed - from.passed;
      const double share = step > 0 ? (wanted - from.passed) / step : 0;
      const bool one_edge = from.edge == to.edge;
      found.push_back(
          {to.edge, one_edge ? from.share + share * (to.share - from.share) : to.share});
    }
    return found;
  }

  Polyline line_;
  bool closed_;
  double parts_;
};

using Pair = std::array<FixedSample, 2>;

// Returns two places on either side of an edge, at the same distance from it.
std::optional<Pair> beside_edge(const Model& model, const PlaceOnEdge& place, double spacings,
                                const Spacing& spacing) {
  const MeshEdge& edge = model.creases.edges[place.edge];
  if (edge.crease != Crease::sharp || !edge.manifold) return {};
  const Barycentric middle =
      place_on_edge(model.mesh.triangles[edge.triangles[0]], edge.ends, place.share);
  const double away = spacings * spacing(model.surface->point(edge.triangles[0], middle));
  const auto on_side = [&](int32_t triangle) -> std::optional<FixedSample> {
    const auto found = walk_from_edge(model.mesh, model.creases, edge, triangle, place.share, away);
    if (!found) return {};
    return on_surface(*model.surface, found->triangle, found->at, spacing);
  };
  const auto left = on_side(edge.triangles[0]), right = on_side(edge.triangles[1]);
  if (!left || !right) return {};
  return Pair{*left, *right};
}

// There is one division of each chain, for the samples on edges and for all rows next to them.
using Divisions = std::vector<std::optional<Division>>;

Divisions divisions_of(const Model& model, bool keep_vertices, const Spacing& spacing,
                       const Run& run) {
  const auto& chains = model.creases.chains;
  Divisions divisions(chains.size());
  parallel_for(
      chains.size(), run,
      [&](int64_t i) { divisions[i].emplace(model, chains[i], keep_vertices, spacing); }, 16);
  return divisions;
}

std::vector<FixedSample> fixed_samples(const Model& model, bool keep_vertices,
                                       const Divisions& divisions, const Spacing& spacing,
                                       const Run& run) {
  auto samples = parallel_append<FixedSample>(
      static_cast<int64_t>(model.mesh.points.size()), run,
      [&](int64_t p, std::vector<FixedSample>& out, int) {
        if (model.mesh.fans[p].empty()) return;  // all triangles there were omitted
        if (keep_vertices || model.creases.corner[p]) {
          out.push_back(at_vertex(*model.surface, model.creases, static_cast<int32_t>(p), spacing));
        }
      });
  const auto along_chains = parallel_append<FixedSample>(
      static_cast<int64_t>(divisions.size()), run,
      [&](int64_t i, std::vector<FixedSample>& out, int) {
        for (const auto& [edge, share] : divisions[i]->ends_of_parts()) {
          out.push_back(on_edge(*model.surface, model.creases, edge, share, spacing));
        }
      },
      16);
  samples.insert(samples.end(), along_chains.begin(), along_chains.end());
  std::stable_sort(samples.begin(), samples.end(),
                   [](const FixedSample& a, const FixedSample& b) { return a.kind < b.kind; });
  return samples;
}

// Returns one row of a hexagonal lattice along each edge; every other row is staggered.
std::vector<Pair> mirrored_row(const Model& model, int row, const Divisions& divisions,
                               const Spacing& spacing, const Run& run) {
  constexpr double kFirstRow = 0.75, kNextRow = 0.85;  // chosen: axis
  return parallel_append<Pair>(
      static_cast<int64_t>(divisions.size()), run,
      [&](int64_t i, std::vector<Pair>& out, int) {
        const Division& division = *divisions[i];
        for (const PlaceOnEdge& place :
             row % 2 == 0 ? division.middles_of_parts() : division.ends_of_parts()) {
          const auto pair = beside_edge(model, place, kFirstRow + kNextRow * row, spacing);
          if (pair) out.push_back(*pair);
        }
      },
      16);
}

std::vector<Disk> disks_of(std::span<const FixedSample> samples) {
  std::vector<Disk> disks;
  for (const FixedSample& s : samples) disks.push_back(disk_of(s));
  return disks;
}

// Puts all samples on creases and next to them in order, those between close walls in pairs.
std::vector<FixedSample> paired(const Model& model, int rows, const Divisions& divisions,
                                const Spacing& spacing, std::span<const FixedSample> samples,
                                const Run& run) {
  PairedSamples made(*model.surface, model.creases, *model.walls, spacing, run);
  made.add_on_creases(samples);
  made.add_rims();
  for (int row = 0; row < rows; ++row) {
    made.add_beside(mirrored_row(model, row, divisions, spacing, run));
  }
  return std::move(made).sorted();
}

// Appends the rows next to the sharp edges where there is room, the nearest first.
void add_mirrored_rows(const Model& model, int rows, const Divisions& divisions,
                       const Spacing& spacing, std::vector<FixedSample>& samples, const Run& run) {
  for (int row = 0; row < rows; ++row) {
    const auto pairs = mirrored_row(model, row, divisions, spacing, run);
    std::vector<std::array<Disk, 2>> disks;
    for (const auto& [left, right] : pairs) disks.push_back({disk_of(left), disk_of(right)});
    for (const int32_t i : free_pairs(disks_of(samples), disks, run)) {
      samples.push_back(pairs[i][0]);
      samples.push_back(pairs[i][1]);
    }
  }
}

struct Attempt {
  std::vector<FixedSample> fixed;
  std::vector<PlacedDisk> placed;

  double count() const { return static_cast<double>(fixed.size() + placed.size()); }
};

// Returns how often curved triangles are cut: a piece should get at least a few darts.
int cuts_for(const Model& model, double expected) {
  if (!model.surface->smooth()) return 0;
  const double per_triangle = kDarts * expected / static_cast<double>(model.mesh.triangles.size());
  return per_triangle < 16 ? 0 : per_triangle < 64 ? 1 : per_triangle < 256 ? 2 : kMostCuts;
}

double crease_length(const Model& model) {
  double sum = 0;
  for (const ChainLink& link : model.creases.chains.items) {
    const Edge& ends = model.creases.edges[link.edge].ends;
    sum += distance(model.mesh.points[ends[0]], model.mesh.points[ends[1]]);
  }
  return sum;
}

// Holds a rough forecast of the number of samples, and the pieces that give it if the spacing
// varies.
struct Expected {
  double count = 0;
  std::vector<Piece> pieces;
};

Expected expected_of(const Model& model, const Spacing& spacing, const Run& run,
                     int64_t most_pieces = INT64_MAX) {
  if (!spacing.field) return {kHexagonal * model.area / (spacing.scale * spacing.scale), {}};
  Expected expected{0, cut_into_pieces(*model.surface, 0, spacing, run, most_pieces)};
  for (const Piece& p : expected.pieces) {
    expected.count += kHexagonal * p.area / (p.spacing * p.spacing);
  }
  return expected;
}

void require_countable(double expected) {
  if (expected <= static_cast<double>(kMostSamples)) return;
  throw InvalidInputError("Expected a spacing that needs at most " + std::to_string(kMostSamples) +
                          " samples, found one that needs about " + text(expected) +
                          "; take a larger one.");
}

Attempt sample_once(const Model& model, const SamplingOptions& options, const Spacing& spacing,
                    Expected expected, const Run& run) {
  const double creases = spacing.field ? 0 : crease_length(model) / spacing.scale;
  require_countable(std::max(expected.count, creases));
  Attempt attempt;
  const auto divisions = divisions_of(model, options.keep_vertices, spacing, run);
  attempt.fixed = fixed_samples(model, options.keep_vertices, divisions, spacing, run);
  if (model.walls) {
    attempt.fixed = paired(model, options.mirrored_rows, divisions, spacing, attempt.fixed, run);
  } else {
    add_mirrored_rows(model, options.mirrored_rows, divisions, spacing, attempt.fixed, run);
  }
  const int cuts = cuts_for(model, expected.count);
  if (cuts > 0 || !spacing.field) {
    expected.pieces = cut_into_pieces(*model.surface, cuts, spacing, run);
  }
  attempt.placed = poisson_disks(*model.surface, expected.pieces, kDisk, disks_of(attempt.fixed),
                                 kDarts, options.seed, run, model.walls ? &*model.walls : nullptr);
  return attempt;
}

Attempt sample_once(const Model& model, const SamplingOptions& options, const Spacing& spacing,
                    const Run& run) {
  return sample_once(model, options, spacing, expected_of(model, spacing, run), run);
}

// Returns the count to aim for. Where vertices are kept, a smaller count than theirs cannot be met,
// and spacings for it would make each of them a neighbour of nearly all others, which are all asked
// for partners.
double wanted_count(const Model& model, const SamplingOptions& options) {
  const auto count = static_cast<double>(*options.count);
  if (!options.keep_vertices || !model.walls) return count;
  return std::max(count, static_cast<double>(model.mesh.points.size()));
}

// This bounds the samples on creases in the first attempt, as a multiple of the count.
constexpr double kMostOnCreases = 256;  // work: memory

// Changes the spacing until the count is met within a hundredth; returns the nearest attempt.
Attempt sample_count(const Model& model, const SamplingOptions& options, const Run& run) {
  constexpr int kAttempts = 8;
  const double wanted = wanted_count(model, options);
  const auto error = [&](const Attempt& t) { return std::abs(t.count() - wanted); };
  // Spikes have length but no area, so their creases alone could take any number of samples.
  const double longest = crease_length(model) / (kMostOnCreases * wanted);
  Spacing spacing{std::max(std::sqrt(kHexagonal * model.area / wanted), longest)};
  Attempt best = sample_once(model, options, spacing, run), last = best;
  for (int i = 1; i < kAttempts && error(best) > 0.01 * wanted; ++i) {
    spacing.scale *= std::sqrt(last.count() / wanted);
    last = sample_once(model, options, spacing, run);
    if (error(last) < error(best)) best = last;
  }
  return best;
}

// Increases spacings that are far too small for a count before there are so many pieces that
// cutting them dominates the time.
Expected bounded(const Model& model, int64_t count, Spacing& spacing, const Run& run) {
  constexpr int64_t kPerSample = 64;
  const auto triangles = static_cast<int64_t>(model.mesh.triangles.size());
  const int64_t most = static_cast<int64_t>(kManyPieces) + kPerSample * (count + triangles);
  Expected expected = expected_of(model, spacing, run, most);
  while (static_cast<int64_t>(expected.pieces.size()) > most) {
    // The pieces so far give a lower bound of the number of samples.
    spacing.scale *= std::max(2.0, std::sqrt(expected.count / (4 * static_cast<double>(count))));
    expected = expected_of(model, spacing, run, most);
  }
  return expected;
}

// If a count bounds the samples, no spacing is below this share of the longest edge, so that pieces
// are not cut too finely.
constexpr double kFinestSpacing = 0x1p-24;  // work: memory

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    longest = std::max({longest, distance(mesh.points[a], mesh.points[b]),
                        distance(mesh.points[b], mesh.points[c]),
                        distance(mesh.points[c], mesh.points[a])});
  }
  return longest;
}

// Samples by the spacings of the sites. All of them are increased by one factor until no more
// samples than allowed are needed.
Attempt sample_sized(const Model& model, const SamplingOptions& options, const Run& run) {
  constexpr int kAttempts = 8;
  std::vector<double> spacings(options.site_spacings.begin(), options.site_spacings.end());
  if (options.count) {
    const double on_creases = kMostOnCreases * static_cast<double>(*options.count);
    const double least =
        std::max(kFinestSpacing * longest_edge(model.mesh), crease_length(model) / on_creases);
    for (double& s : spacings) s = std::max(s, least);
  }
  const SizingField field(*options.sites, spacings, run, options.pairs);
  Spacing spacing{1, &field};
  if (!options.count) return sample_once(model, options, spacing, run);
  const double most = wanted_count(model, options);
  Expected expected = bounded(model, *options.count, spacing, run);
  for (int i = 0; i < 2 && expected.count > most; ++i) {
    spacing.scale *= std::sqrt(expected.count / most);
    expected = expected_of(model, spacing, run);
  }
  Attempt attempt = sample_once(model, options, spacing, std::move(expected), run);
  for (int i = 1; i < kAttempts && attempt.count() > most; ++i) {
    spacing.scale *= 1.002 * std::sqrt(attempt.count() / most);
    attempt = sample_once(model, options, spacing, run);
  }
  return attempt;
}

void require_valid_sites(const SamplingOptions& options) {
  require_finite(*options.sites, "site");
  if (options.sites->empty() || options.sites->size() != options.site_spacings.size()) {
    throw InvalidInputError("Expected one spacing for each of at least one site, found " +
                            std::to_string(options.site_spacings.size()) + " for " +
                            std::to_string(options.sites->size()) + "; give as many.");
  }
  for (const double s : options.site_spacings) {
    if (s > 0 && s < HUGE_VAL) continue;
    throw InvalidInputError("Expected positive spacings of the sites, found " + text(s) +
                            "; correct it.");
  }
}

void require_valid(const SamplingOptions& options, size_t vertices) {
  const bool density = options.count && !options.sites;
  if (density + options.spacing.has_value() + options.sites.has_value() != 1) {
    throw InvalidInputError(
        "Expected one of count, spacing and sizing, or sizing with a count, found another "
        "choice; leave out the others.");
  }
  if (options.count && (*options.count < 1 || *options.count > kMostSamples)) {
    throw InvalidInputError("Expected a count of 1 to " + std::to_string(kMostSamples) +
                            ", found " + std::to_string(*options.count) + "; change it.");
  }
  if (options.spacing && !(*options.spacing > 0 && *options.spacing < HUGE_VAL)) {
    throw InvalidInputError("Expected a positive spacing, found " + text(*options.spacing) +
                            "; change it.");
  }
  if (!(options.sharp_angle >= 0 && options.sharp_angle <= std::numbers::pi)) {
    throw InvalidInputError("Expected a sharp_angle of 0 to pi, found " +
                            text(options.sharp_angle) + "; change it.");
  }
  if (options.mirrored_rows < 0 || options.mirrored_rows > kMostRows) {
    throw InvalidInputError("Expected mirrored_rows of 0 to " + std::to_string(kMostRows) +
                            ", found " + std::to_string(options.mirrored_rows) + "; change it.");
  }
  if (options.sites) require_valid_sites(options);
  for (const auto& edge : options.sharp_edges) {
    for (const int32_t row : edge) {
      if (row >= 0 && static_cast<size_t>(row) < vertices) continue;
      throw InvalidInputError("Expected rows of sharp_edges below " + std::to_string(vertices) +
                              ", found " + std::to_string(row) + "; mark the edges again.");
    }
  }
}

// Returns the largest curvature across the sides of a triangle: the turn of the normals over the
// way between the middles of the triangles.
double bend_of(const Model& model, int32_t triangle) {
  constexpr double kMiddle = 0.4;  // of the heights over the common side; chosen: axis
  const auto &points = model.mesh.points, &normal = model.mesh.normal;
  const auto& triangles = model.mesh.triangles;
  const Triangle& t = triangles[triangle];
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const MeshEdge& edge = model.creases.edges[model.creases.find(t[i], t[(i + 1) % 3])];
    if (edge.crease != Crease::none || !edge.manifold) continue;
    const Vec3 side = normalized(points[edge.ends[1]] - points[edge.ends[0]]);
    double way = 0;
    for (const int32_t at : edge.triangles) {
      const Triangle& c = triangles[at];
      const int32_t third = c[0] + c[1] + c[2] - edge.ends[0] - edge.ends[1];
      way += kMiddle * length(cross(points[third] - points[edge.ends[0]], side));
    }
    const double turn = distance(normal[edge.triangles[0]], normal[edge.triangles[1]]);
    if (turn > most * way) most = turn / way;
  }
  return most;
}

void append(const Model& model, const Attempt& attempt, SurfaceSamples& samples) {
  const auto add = [&](const Vec3& point, const Vec3& normal, int32_t triangle,
                       const Barycentric& at, SampleKind kind, double radius, int64_t partner) {
    samples.points.push_back(point);
    samples.normals.push_back(normal);
    samples.triangle.push_back(model.mesh.source[triangle]);
    samples.barycentric.push_back({at.a, at.b, at.c});
    samples.kind.push_back(kind);
    samples.radius.push_back(radius);
    samples.partner.push_back(static_cast<int32_t>(partner));
    samples.bend.push_back(partner < 0 ? 0 : bend_of(model, triangle));
  };
  for (const FixedSample& s : attempt.fixed) {
    add(s.point, s.normal, s.triangle, s.at, s.kind, s.radius, s.partner);
  }
  for (const auto& [disk, triangle, at, to_partner] : attempt.placed) {
    const auto own = static_cast<int64_t>(samples.points.size());
    add(disk.centre, disk.normal, triangle, at, SampleKind::surface, disk.radius,
        to_partner == 0 ? -1 : own + to_partner);
  }
}

}  // namespace

SurfaceSamples sample_surface(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                              const SamplingOptions& options, int threads, Progress* progress) {
  const Run run{thread_count(threads), progress};
  require_valid(options, vertices.size());
  begin_stage(run.progress, "Sharp edges", 0, 0.2);
  const Model model(vertices, triangles, options, run);
  begin_stage(run.progress, "Sampling", 0.2, 1);
  const Attempt attempt = options.sites   ? sample_sized(model, options, run)
                          : options.count ? sample_count(model, options, run)
                                          : sample_once(model, options, {*options.spacing}, run);
  SurfaceSamples samples;
  append(model, attempt, samples);
  for (const MeshEdge& edge : model.creases.edges) {
    if (edge.crease != Crease::sharp) continue;
    samples.sharp_edges.push_back({model.mesh.row[edge.ends[0]], model.mesh.row[edge.ends[1]]});
  }
  samples.area = model.area;
  return samples;
}

}  // namespace medial
