// SPDX-License-Identifier: GPL-3.0-or-later
// A medial mesh describes a solid by few spheres with edges and triangles between them: the union
// of the balls, of the cones along edges, and of the slabs along triangles, with linearly
// interpolated radii.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <optional>
#include <span>

namespace medial {

// The mesh has the spheres, and says which of them are joined.
struct SphereMesh {
  Column<Vec3> vertices;
  Column<double> radius;       // (v) 0 or more
  Column<Triangle> triangles;  // each once
  Column<Edge> wires;          // edges that are on no triangle, i < j, each once, ascending
};

// These options choose how small the result is.
struct ReduceOptions {
  int32_t vertices = 200;  // that are wanted at most
  int threads = 0;         // 0: as many as the machine has; the result does not depend on it
};

// Returns about the same solid with fewer vertices and the same homotopy type. Edges are collapsed,
// first those that change the surface of the solid least, if the link condition holds; then the
// spheres are fitted to that surface. If no more edges can be collapsed, more vertices stay than
// wanted. Throws InvalidInputError for rows out of range, numbers that are not finite, negative
// radii and less than one wanted vertex; Cancelled.
SphereMesh reduce(const SphereMesh& given, const ReduceOptions& options,
                  Progress* progress = nullptr);

// The sheets of a sphere mesh, and the nodes where their curves meet.
struct SheetLabels {
  std::span<const int32_t> part;   // (t) the sheet of each triangle
  std::span<const int32_t> nodes;  // vertices that stay where they are
  double shortest = 0;             // edges of their curves are not shorter, if that can be
};

// A small medial mesh of sheets: flat ones are polygons, the others triangles.
struct SheetMesh {
  Column<Vec3> vertices;
  Column<double> radius;         // (v)
  Column<int32_t> row;           // (v) row of the given vertex that it is, -1 where it has moved
  Column<int32_t> face_offsets;  // (f + 1)
  Column<int32_t>
      face_vertices;     // each polygon turns as its triangles did, and touches no corner twice
  Column<int32_t> part;  // (f) ascending
  Column<Edge> wires;    // edges that are on no face, i < j, each once, ascending
};

// Reduces a mesh sheet by sheet. Its nodes stay. Vertices of a curve, where sheets end or meet,
// merge along the curve only, and those with radius 0 stay where one of them was; vertices inside a
// sheet merge as in reduce(), without a fit. Curves that are straight and sheets that are flat keep
// no vertex that changes nothing, however many are wanted. The homotopy type stays. Triangles of a
// sheet that lie in one plane, with radii that change linearly, are joined to polygons whose
// boundary is one loop; a flat sheet with a hole has two of them or more.
//
// Returns nothing if fewer vertices are wanted than there are nodes and bent curves: reduce() makes
// a better solid of so few. Throws as reduce() does, and InvalidInputError for labels that do not
// fit.
std::optional<SheetMesh> reduce_sheets(const SphereMesh& given, const SheetLabels& labels,
                                       const ReduceOptions& options, Progress* progress = nullptr);

// Returns the signed distance of each query to the slabs, cones and balls, negative inside. Outside
// it is the distance to the solid; inside, the surface is at least as far away.
std::vector<double> solid_distances(std::span<const Vec3> queries, const SphereMesh& mesh,
                                    int threads = 0, Progress* progress = nullptr);

// Returns points on the surface of the solid, no farther apart than about `spacing`.
Column<Vec3> solid_surface(const SphereMesh& given, double spacing, int threads = 0,
                           Progress* progress = nullptr);

}  // namespace medial
