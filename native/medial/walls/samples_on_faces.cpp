// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/samples_on_faces.h"

#include "base/portable_math.h"

namespace medial {
namespace {

// All lengths are in holes: the largest circumradius in the umbrella of a sample, about 0.6 of the
// distance between samples of blue noise.
constexpr double kOnCrease = 1e-6;  // from a sample on a crease to that crease; derived: rounding
constexpr double kNearSamples = 6;  // from a place of the faces to a sample; chosen: axis
constexpr double kReach = 1.5;  // from where two tangent planes meet to a crease; chosen: unseen

// Returns the point nearest to `at` in which two planes meet.
Vec3 apex(const Vec3& p, const Vec3& n, const Vec3& q, const Vec3& m, const Vec3& at) {
  const double cosine = dot(n, m), determinant = 1 - cosine * cosine;
  const double to_p = dot(p - at, n), to_q = dot(q - at, m);
  return at + ((to_p - cosine * to_q) / determinant) * n +
         ((to_q - cosine * to_p) / determinant) * m;
}

double middle_of(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  if (sorted.empty()) return 0;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

}  // namespace

SamplesOnFaces::SamplesOnFaces(const FacesInput& input, const Faces& faces, const Samples& samples,
                               std::span<const double> spacing, const Run& run)
    : faces_(faces),
      creases_(faces, middle_of(spacing)),
      spacing_(spacing.begin(), spacing.end()),
      tree_(std::span(samples.points.data(), samples.row.size())),
      reach_(kNearSamples * middle_of(spacing)),
      most_alike_(portable::cos(input.sharp_angle)),
      triangle_(samples.row.size(), -1),
      normals_(samples.row.size()),
      on_crease_(samples.row.size(), 0) {
  parallel_for(static_cast<int64_t>(triangle_.size()), run, [&](int64_t s) {
    const int32_t triangle = faces.triangle_of(input.face[samples.row[s]]);
    if (triangle >= 0) place(static_cast<int32_t>(s), triangle);
  });
}

void SamplesOnFaces::place(int32_t s, int32_t triangle) {
  const Vec3& point = tree_[s];
  triangle_[s] = triangle;
  const Foot foot = faces_.foot_on(triangle, point);
  normals_[s][0] = faces_.normal(triangle, foot.at);
  const auto crease = creases_.nearer(point, kOnCrease * spacing_[s]);
  on_crease_[s] = crease && creases_.divides(crease->edge);
  const double coordinates[3] = {foot.at.a, foot.at.b, foot.at.c};
  for (int i = 0; i < 3; ++i) {
    const int32_t e = faces_.edge_of(triangle, (i + 1) % 3);
    const MeshEdge& edge = faces_.creases().edges[e];
    if (coordinates[i] > kOnCrease || edge.crease != Crease::sharp || faces_.separates(e)) continue;
    normals_[s][1] = faces_.mesh().normal[edge.triangles[edge.triangles[0] == triangle]];
  }
}

size_t SamplesOnFaces::bytes() const {
  return tree_.bytes() + triangle_.size() * (sizeof(double) + sizeof(int32_t) + 1) +
         normals_.size() * sizeof(normals_[0]);
}

bool SamplesOnFaces::are_near(const Vec3& place) const { return tree_.has_within(place, reach_); }

double SamplesOnFaces::within_faces(const Vec3& centre, double radius) const {
  const auto foot = faces_.nearer(centre, radius);
  if (!foot || !are_near(foot->point)) return radius;
  return foot->distance;
}

std::optional<PlaceOnCrease> SamplesOnFaces::crease_between(const Edge& samples,
                                                            const Vec3& at) const {
  const auto& [p, q] = samples;
  if (creases_.empty() || triangle(p) < 0 || triangle(q) < 0) return {};
  if (on_crease_[p] && on_crease_[q]) return {};
  if (on_crease_[p] || on_crease_[q]) {
    const int32_t s = on_crease_[p] ? p : q;
    return creases_.nearer(point(s), kReach * spacing_[s]);
  }
  const double reach = kReach * std::max(spacing_[p], spacing_[q]);
  for (const Vec3& n : normals_[p]) {
    for (const Vec3& m : normals_[q]) {
      const auto meeting = meeting_of_planes(samples, n, m, at);
      if (!meeting) continue;
      const auto found = creases_.nearer(*meeting, reach);
      if (found && lies_between(found->edge, n, m)) return found;
    }
  }
  return {};
}

std::optional<Vec3> SamplesOnFaces::meeting_of_planes(const Edge& samples, const Vec3& n,
                                                      const Vec3& m, const Vec3& at) const {
  const auto& [p, q] = samples;
  const Vec3 across = point(q) - point(p);
  const bool convex = dot(across, n) < 0 && dot(across, m) > 0;
  if (!convex || !(dot(n, m) < most_alike_) || !(dot(n, m) > -1)) return {};
  return apex(point(p), n, point(q), m, at);
}

bool SamplesOnFaces::lies_between(int32_t crease, const Vec3& n, const Vec3& m) const {
  const auto& [a, b] = faces_.creases().edges[crease].triangles;
  const auto are_alike = [&](int32_t triangle, const Vec3& normal) {
    return dot(faces_.mesh().normal[triangle], normal) > most_alike_;
  };
  return (are_alike(a, n) && are_alike(b, m)) || (are_alike(a, m) && are_alike(b, n));
}

bool SamplesOnFaces::are_opposite_reflex_edges(const Edge& samples) const {
  const auto& [p, q] = samples;
  const Vec3 none{};
  if (normals_[p][1] == none || normals_[q][1] == none) return false;
  const Vec3 across = point(q) - point(p);
  const double steep = -kOpposite * length(across);
  for (const Vec3& n : normals_[p]) {
    for (const Vec3& m : normals_[q]) {
      if (dot(across, n) < -steep && dot(across, m) > steep && dot(n, m) < kOpposite) return true;
    }
  }
  return false;
}

EdgeMark SamplesOnFaces::mark(const Edge& samples) const {
  const auto& [p, q] = samples;
  if (on_crease_[p] != on_crease_[q]) return EdgeMark::at_crease;
  if (are_opposite_reflex_edges(samples)) return EdgeMark::between_partners;
  const Vec3 middle = 0.5 * point(p) + 0.5 * point(q);
  const auto crease = crease_between(samples, middle);
  return crease && creases_.divides(crease->edge) ? EdgeMark::into_crease : EdgeMark::none;
}

std::vector<EdgeMark> crease_marks(const SamplesOnFaces& samples, const Edges& edges,
                                   const Run& run) {
  if (samples.creases().empty()) return {};
  std::vector<EdgeMark> marks(edges.ends.size());
  parallel_for(edges.count(), run, [&](int64_t e) { marks[e] = samples.mark(edges.ends[e]); });
  return marks;
}

}  // namespace medial
