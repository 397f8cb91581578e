// The triangles of the sampled surface: their topology, and how far each sample can speak for the space round it.
#pragma once

#include "complex.h"
#include "winding_number.h"

namespace medial {

struct Surface {
  std::vector<Triangle> triangles;  // sample ids, outward; triangles with a repeated corner are left out
  Csr<int32_t> fans;                // triangles at each sample
  int64_t boundary_edges = 0;       // edges not used equally often in both directions

  // Then the winding number is an integer everywhere off the surface.
  bool closed() const { return !triangles.empty() && boundary_edges == 0; }
};

// `triangles` holds input rows.
Surface make_surface(std::span<const Triangle> triangles, std::span<const int32_t> sample_of_row,
                     int32_t samples, const Run& run);

// A sample is trusted when
// - its triangles form one fan whose normals all lie within 90 degrees of their angle-weighted mean, and
// - no other triangle enters its Voronoi cell.
// The segment from such a sample p to a point c of its Voronoi cell meets no triangle but those at p, so the position
// of c relative to p's fan tells how the winding number changes along it. Along a triangle with three trusted corners
// nothing else touches the surface, so the winding number outside the fans is one constant per patch.
struct Trust {
  std::vector<int32_t> patch;  // connected patch of each sample, -1: not trusted
  std::vector<Vec3> normal;    // angle-weighted unit normal
  std::vector<double> sine;    // of the largest angle between it and a normal of the fan
  int32_t patches = 0;
};

Trust trusted_samples(std::span<const Vec3> points, const Surface& surface,
                      const Triangulation& triangulation, const Csr<int32_t>& incident, const Run& run);

}  // namespace medial
