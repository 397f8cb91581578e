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
  int mirrored_rows = 2;  // next to each sharp edge, on either side
  bool pairs = false;     // between close walls samples lie opposite each other
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
  // The sample on the opposite wall, or -1. Of several partners one is named; two samples are
  // partners if either names the other.
  std::vector<int32_t> partner;
  std::vector<double> bend;       // curvature of the surface at samples with partners; else 0
  std::vector<Edge> sharp_edges;  // rows of vertices, p < q, sorted
  double area = 0;
};

// Samples a surface. `threads` 0 means all cores; the result does not depend on it. Throws
// InvalidInputError for an option out of its range, or if no triangle has an area; Cancelled.
SurfaceSamples sample_surface(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                              const SamplingOptions& options, int threads = 0,
                              Progress* progress = nullptr);

// Samples for surface_patches, one row each, such as those of sample_surface.
struct SamplePlaces {
  std::span<const Vec3> points;
  std::span<const SampleKind> kind;
  std::span<const int32_t> triangle;  // input row, -1 for samples that close openings
};

// Patches are the parts into which the sharp convex edges divide a surface: one patch continues
// across reflex edges, and round the end of a crease.
struct SurfacePatches {
  // (m) in the order of their first triangles; -1 for triangles that are repeated or have a corner
  // twice.
  std::vector<int32_t> of_triangle;
  // Per sample, or per vertex if there are no samples: its patch and -1; both patches, ascending,
  // where two meet; twice -1 where more meet, and where it is on no triangle. Samples that close
  // openings have one more patch, after all others.
  std::vector<Edge> of_sample;
};

// Finds the patches. Edges are sharp as for sample_surface, and sharp convex edges, edges of more
// than two triangles, and those that two triangles pass in the same direction divide patches.
// Throws InvalidInputError for an option out of its range and for samples that do not fit.
SurfacePatches surface_patches(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                               const SamplePlaces* samples, double sharp_angle,
                               std::span<const Edge> sharp_edges, int threads = 0);

}  // namespace medial
