// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/samples_on_faces.h"

namespace medial {
namespace {

constexpr double kOnCrease = 1e-6;  // the distance of a sample that lies on a crease, in spacings
constexpr double kReach = 0.9;      // from where the tangent planes meet to a crease, in spacings

// Returns the point nearest to `at` in which two planes meet.
Vec3 apex(const Vec3& p, const Vec3& n, const Vec3& q, const Vec3& m, const Vec3& at) {
  const double cosine = dot(n, m), determinant = 1 - cosine * cosine;
  const double to_p = dot(p - at, n), to_q = dot(q - at, m);
  return at + ((to_p - cosine * to_q) / determinant) * n +
         ((to_q - cosine * to_p) / determinant) * m;
}

}  // namespace

SamplesOnFaces::SamplesOnFaces(const FacesInput& input, const Faces& faces, const Samples& samples,
                               std::span<const double> spacing, const Run& run)
    : faces_(faces),
      creases_(faces),
      samples_(samples),
      spacing_(spacing),
      most_alike_(std::cos(input.sharp_angle)),
      triangle_(samples.row.size(), -1),
      normal_(samples.row.size()),
      on_crease_(samples.row.size(), 0) {
  parallel_for(static_cast<int64_t>(triangle_.size()), run, [&](int64_t s) {
    const Vec3& point = samples.points[s];
    triangle_[s] = faces.triangle_of(input.face[samples.row[s]]);
    if (triangle_[s] < 0) return;
    const Foot foot = faces.foot_on(triangle_[s], point);
    normal_[s] = faces.normal(triangle_[s], foot.at);
    on_crease_[s] = creases_.nearer(point, kOnCrease * spacing[s]).has_value();
  });
}

std::optional<PlaceOnCrease> SamplesOnFaces::crease_between(const Edge& samples,
                                                            const Vec3& at) const {
  const auto& [p, q] = samples;
  if (creases_.empty() || triangle(p) < 0 || triangle(q) < 0) return {};
  if (on_crease_[p] || on_crease_[q]) return {};
  const Vec3 &n = normal_[p], &m = normal_[q], across = point(q) - point(p);
  const bool convex = dot(across, n) < 0 && dot(across, m) > 0;
  if (!convex || !(dot(n, m) < most_alike_) || !(dot(n, m) > -1)) return {};
  const double reach = kReach * std::max(spacing_[p], spacing_[q]);
  return creases_.nearer(apex(point(p), n, point(q), m, at), reach);
}

CreaseMark SamplesOnFaces::mark(const Edge& samples) const {
  const auto& [p, q] = samples;
  if (on_crease_[p] != on_crease_[q]) return CreaseMark::at_crease;
  const Vec3 middle = 0.5 * point(p) + 0.5 * point(q);
  return crease_between(samples, middle) ? CreaseMark::into_crease : CreaseMark::none;
}

std::vector<CreaseMark> crease_marks(const SamplesOnFaces& samples, const Edges& edges,
                                     const Run& run) {
  if (samples.creases().empty()) return {};
  std::vector<CreaseMark> marks(edges.ends.size());
  parallel_for(edges.count(), run, [&](int64_t e) { marks[e] = samples.mark(edges.ends[e]); });
  return marks;
}

}  // namespace medial
