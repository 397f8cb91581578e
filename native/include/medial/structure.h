// SPDX-License-Identifier: GPL-3.0-or-later
// The structure of a medial axis: its sheets, the seams where sheets meet, the rims where they end,
// and the junctions and corners where these meet.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <span>

namespace medial {

// This is an axis as polygons, such as a Level, and what is known of the samples that made it.
struct StructureInput {
  std::span<const Vec3> vertices;          // (v)
  std::span<const double> radius;          // (v)
  std::span<const int32_t> face_offsets;   // (f + 1)
  std::span<const int32_t> face_vertices;  // counter-clockwise about the direction p -> q
  std::span<const Edge> generators;        // (f) input rows p, q
  std::span<const Edge> wires;             // (w) edges without a facet
  std::span<const Edge> patches;           // per input row, as SurfacePatches::of_sample
  std::span<const double> spacing;         // per input row: the distance of neighbours there
};

// A crease is a rim where a sheet reaches a sharp convex edge of the solid.
enum class CurveKind : int32_t { none, seam, rim, crease };
// A vertex of a wire lies on no facet.
enum class PlaceKind : int32_t { sheet, seam, junction, rim, corner, wire };

// Parts, curves and nodes have numbers by rules that do not know the samples: parts are in the
// order of their pairs of patches, curves in that of their kinds and parts, nodes in that of their
// kinds and curves. Where these agree, the order is that of the middles, by x, by y where x differs
// by less than a spacing, and by z.
struct Structure {
  Column<int32_t> part;       // (f)
  Column<uint8_t> turned;     // (f) whether it must be turned to agree with its part
  Column<Edge> edges;         // (e) those of the facets, as polygon_edges
  Column<CurveKind> seam;     // (e)
  Column<int32_t> curve;      // (e) number of the curve; -1 where none or one too short to count
  Column<PlaceKind> kind;     // (v)
  Column<Edge> part_patches;  // (p) lower patch first; -1 where it is not known
  Column<double> part_area, part_mean_radius, part_least_radius;       // (p)
  Column<CurveKind> curve_kind;                                        // (c)
  Column<double> curve_length, curve_mean_radius, curve_least_radius;  // (c)
  Column<int32_t> curve_part_offsets, curve_parts;  // (c + 1) and the parts at each curve
  Column<PlaceKind> node_kind;                      // (n) junction or corner
  Column<int32_t> node_vertex;                      // (n)
  Column<int32_t> node_curve_offsets, node_curves;  // (n + 1) and the curves at each node
};

// Finds the structure. Facets are in one sheet if they are connected across edges of two facets and
// lie between the same patches. Sheets smaller than two squared spacings go to the neighbour with
// the longest common edge, and curves shorter than 1.5 spacings do not count. Throws
// InvalidInputError for arrays that do not fit. The result does not depend on the threads.
Structure structure_of(const StructureInput& input, int threads = 0);

}  // namespace medial
