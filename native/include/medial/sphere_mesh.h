// SPDX-License-Identifier: GPL-3.0-or-later
// A solid as few spheres with edges and triangles between them (a medial mesh): the union of the
// balls, of the cones along edges, and of the slabs along triangles, in which radii run linearly.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <span>

namespace medial {

// The spheres, and which of them are joined.
struct SphereMesh {
  Column<Vec3> vertices;
  Column<double> radius;       // (v) 0 or more
  Column<Triangle> triangles;  // each once
  Column<Edge> wires;          // edges that are on no triangle, i < j, each once, ascending
};

// How small it is to be.
struct ReduceOptions {
  int32_t vertices = 200;  // that are wanted at most
  int threads = 0;         // 0: as many as the machine has; the result does not depend on it
};

// The same solid with fewer vertices, of the same homotopy type: edges are collapsed, those first
// that change the surface of the solid least, as long as the link condition holds, and then the
// spheres are fitted to that surface. Where no more edge can be collapsed, more vertices stay than
// wanted. Throws InvalidInputError for rows out of range, numbers that are not finite, negative
// radii and less than one wanted vertex; Cancelled.
SphereMesh reduce(const SphereMesh& given, const ReduceOptions& options,
                  Progress* progress = nullptr);

// The signed distance of each query to the slabs, cones and balls, negative inside: outside that to
// the solid; inside at least as far away is its surface.
std::vector<double> solid_distances(std::span<const Vec3> queries, const SphereMesh& mesh,
                                    int threads = 0, Progress* progress = nullptr);

// Points on the surface of the solid, no farther apart than about `spacing`.
Column<Vec3> solid_surface(const SphereMesh& given, double spacing, int threads = 0,
                           Progress* progress = nullptr);

}  // namespace medial
