// SPDX-License-Identifier: GPL-3.0-or-later
// A triangulated surface is sampled at its corners, along sharp edges, and by blue noise in
// between.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <optional>
#include <span>

namespace medial {

// Openings are the places of closing_samples; sample_surface makes none.
enum class SampleKind : int32_t { corner, sharp, boundary, vertex, surface, opening };

// These options choose the density, the sharp edges, and further samples.
struct SamplingOptions {
  std::optional<int64_t> count = {};  // one of count, spacing and sites
  std::optional<double> spacing = {};
  std::optional<std::span<const Vec3>> sites = {};
  std::span<const double> site_spacings = {};
  double sharp_angle = 0.52359877559829887;  // pi / 6
  std::span<const Edge> sharp_edges = {};    // rows of vertices
  bool smooth = false;
  bool keep_vertices = false;
  int mirrored_rows = 2;  // beside each sharp edge, on either side
  uint64_t seed = 0;
};

// There is one row per sample, corners first.
struct SurfaceSamples {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;      // outward; where sides meet their mean; zero where there is none
  std::vector<int32_t> triangle;  // input row
  std::vector<Vec3> barycentric;
  std::vector<SampleKind> kind;  // ascending
  std::vector<double> radius;
  std::vector<Edge> sharp_edges;  // rows of vertices, p < q, sorted
  double area = 0;
};

// Samples a surface. `threads` 0 means all cores; the result does not depend on it. Throws
// InvalidInputError for an option out of its range, or if no triangle has an area; Cancelled.
SurfaceSamples sample_surface(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                              const SamplingOptions& options, int threads = 0,
                              Progress* progress = nullptr);

}  // namespace medial
