// SPDX-License-Identifier: GPL-3.0-or-later
#include <medial/errors.h>
#include <medial/sampling.h>

#include <numbers>

#include "base/text.h"
#include "base/union_find.h"
#include "sampling/creases.h"

namespace medial {
namespace {

// Collects the patches that meet somewhere.
class Meeting {
 public:
  void add(int32_t patch) {
    if (patch < 0 || patch == found_[0] || patch == found_[1]) return;
    if (count_ < 2) found_[count_] = patch;
    ++count_;
  }
  Edge patches() const {
    if (count_ > 2) return {-1, -1};
    return count_ == 2 ? Edge{std::min(found_[0], found_[1]), std::max(found_[0], found_[1])}
                       : found_;
  }

 private:
  Edge found_{-1, -1};
  int count_ = 0;
};

// Divides a surface into patches.
class Patches {
 public:
  Patches(std::span<const Vec3> vertices, std::span<const Triangle> triangles, double sharp_angle,
          std::span<const Edge> rows, const Run& run)
      : mesh_(make_mesh(vertices, triangles, run)),
        creases_(find_creases(mesh_, sharp_angle, marked_edges(vertices, rows, mesh_, triangles),
                              false, run)),
        number_(numbered()),
        triangle_of_(triangles.size(), -1) {
    for (size_t t = 0; t < mesh_.source.size(); ++t) {
      triangle_of_[mesh_.source[t]] = static_cast<int32_t>(t);
    }
  }

  std::vector<int32_t> of_triangles() const {
    std::vector<int32_t> result;
    for (const int32_t t : triangle_of_) result.push_back(t < 0 ? -1 : number_[t]);
    return result;
  }

  std::vector<Edge> of_vertices(size_t vertices) const {
    std::vector<Edge> result(vertices, {-1, -1});
    for (size_t p = 0; p < mesh_.row.size(); ++p) {
      result[mesh_.row[p]] = at_point(static_cast<int32_t>(p));
    }
    return result;
  }

  std::vector<Edge> of_samples(const SamplePlaces& samples, const Run& run) const {
    const auto open = std::find(samples.kind.begin(), samples.kind.end(), SampleKind::opening) !=
                      samples.kind.end();
    std::vector<Edge> result(samples.points.size());
    parallel_for(static_cast<int64_t>(result.size()), run, [&](int64_t i) {
      const int32_t row = samples.triangle[i];
      const int32_t t = row < 0 ? -1 : triangle_of_[row];
      if (samples.kind[i] == SampleKind::opening) {
        result[i] = {count_, -1};
      } else {
        result[i] = t < 0 ? Edge{-1, -1} : at(samples.points[i], samples.kind[i], t, open);
      }
    });
    return result;
  }

 private:
  bool divides(const MeshEdge& edge) const {
    if (!edge.manifold) return true;
    if (edge.crease != Crease::sharp) return false;
    const auto& [a, b] = edge.triangles;
    const auto& [p, q] = edge.ends;
    const bool forward = link_of(mesh_.triangles[a], p)[0] == q;
    const Vec3 along = normalized(mesh_.points[q] - mesh_.points[p]);
    const double turn = dot(cross(mesh_.normal[a], mesh_.normal[b]), along);
    return (forward ? turn : -turn) > kAngleRounding ||
           folds_back(mesh_.normal[a], mesh_.normal[b]);
  }
  // Returns whether two normals are so nearly opposite that their turn says nothing.
  static bool folds_back(const Vec3& a, const Vec3& b) {
    return dot(a, b) < 0 && length(cross(a, b)) <= kAngleRounding;
  }

  // Returns the patch of each triangle of the mesh, and counts the patches.
  std::vector<int32_t> numbered() {
    UnionFind sets(mesh_.triangles.size());
    for (const MeshEdge& edge : creases_.edges) {
      if (edge.triangles[1] >= 0 && !divides(edge)) {
        sets.unite(edge.triangles[0], edge.triangles[1]);
      }
    }
    const auto first = std::move(sets).representatives();
    std::vector<int32_t> number(first.size(), -1);
    for (size_t t = 0; t < number.size(); ++t) {
      int32_t& patch = number[first[t]];
      if (patch < 0) patch = count_++;
      number[t] = patch;
    }
    return number;
  }

  Edge at_point(int32_t point) const {
    Meeting meeting;
    for (const int32_t t : mesh_.fans[point]) meeting.add(number_[t]);
    return meeting.patches();
  }

  Edge at(const Vec3& place, SampleKind kind, int32_t triangle, bool open) const {
    if (kind == SampleKind::surface) return {number_[triangle], -1};
    if (kind == SampleKind::corner || kind == SampleKind::vertex) {
      return at_point(nearest_corner(place, triangle));
    }
    const Edge ends = nearest_side(place, triangle);
    Meeting meeting;
    for (const int32_t t : mesh_.fans[ends[0]]) {
      const auto [next, previous] = link_of(mesh_.triangles[t], ends[0]);
      if (next == ends[1] || previous == ends[1]) meeting.add(number_[t]);
    }
    if (open && kind == SampleKind::boundary) meeting.add(count_);
    return meeting.patches();
  }

  int32_t nearest_corner(const Vec3& place, int32_t triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    return *std::min_element(t.begin(), t.end(), [&](int32_t a, int32_t b) {
      return distance(mesh_.points[a], place) < distance(mesh_.points[b], place);
    });
  }

  Edge nearest_side(const Vec3& place, int32_t triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    Edge nearest{};
    double least = HUGE_VAL;
    for (int i = 0; i < 3; ++i) {
      const Edge side{t[i], t[(i + 1) % 3]};
      const Vec3 along = mesh_.points[side[1]] - mesh_.points[side[0]];
      const Vec3 to = place - mesh_.points[side[0]];
      const double share = std::clamp(dot(to, along) / squared_length(along), 0.0, 1.0);
      const double away = length(to - share * along);
      if (away < least) {
        least = away;
        nearest = side;
      }
    }
    return nearest;
  }

  TriangleMesh mesh_;
  Creases creases_;
  int32_t count_ = 0;
  std::vector<int32_t> number_;       // patch of each triangle of the mesh
  std::vector<int32_t> triangle_of_;  // of the mesh, per input row, or -1
};

void require_patch_input(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                         const SamplePlaces* samples, double sharp_angle,
                         std::span<const Edge> sharp_edges) {
  if (!(sharp_angle >= 0 && sharp_angle <= std::numbers::pi)) {
    throw InvalidInputError("Expected a sharp_angle of 0 to pi, found " + text(sharp_angle) +
                            "; change it.");
  }
  const auto outside = [](int32_t row, size_t rows) {
    return row < 0 || static_cast<size_t>(row) >= rows;
  };
  for (const auto& [p, q] : sharp_edges) {
    if (!outside(p, vertices.size()) && !outside(q, vertices.size())) continue;
    throw InvalidInputError(
        "Expected rows of sharp_edges below " + std::to_string(vertices.size()) + ", found " +
        std::to_string(outside(p, vertices.size()) ? p : q) + "; mark the edges again.");
  }
  if (samples == nullptr) return;
  const size_t count = samples->points.size();
  if (samples->kind.size() != count || samples->triangle.size() != count) {
    throw InvalidInputError("Expected a kind and a triangle of each of the " +
                            std::to_string(count) + " samples, found " +
                            std::to_string(samples->kind.size()) + " and " +
                            std::to_string(samples->triangle.size()) + "; pass all of them.");
  }
  for (const int32_t t : samples->triangle) {
    if (t == -1 || !outside(t, triangles.size())) continue;
    throw InvalidInputError("Expected triangles of samples below " +
                            std::to_string(triangles.size()) + ", found " + std::to_string(t) +
                            "; sample the surface again.");
  }
}

}  // namespace

SurfacePatches surface_patches(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                               const SamplePlaces* samples, double sharp_angle,
                               std::span<const Edge> sharp_edges, int threads) {
  require_patch_input(vertices, triangles, samples, sharp_angle, sharp_edges);
  const Run run{thread_count(threads)};
  const Patches patches(vertices, triangles, sharp_angle, sharp_edges, run);
  return {patches.of_triangles(), samples == nullptr ? patches.of_vertices(vertices.size())
                                                     : patches.of_samples(*samples, run)};
}

}  // namespace medial
