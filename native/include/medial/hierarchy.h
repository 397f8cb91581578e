// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy of the inner medial axis: one ordered collapse of the inner Voronoi complex, from
// which every level of simplification, the curve skeleton included, is read. Each has the topology
// of the solid.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <memory>

namespace medial {

using Betti = std::array<int64_t, 3>;  // components, tunnels, cavities

// What a cell has to exceed to stay. A cell stays if it exceeds the first three, or the last one;
// and all stay that the collapse left. Infinity takes all away that can go.
struct LevelThresholds {
  double sheet = 0;     // thickness of its sheet, as a share of the diagonal
  double spacings = 0;  // the same in local spacings of the samples
  double erosion = 0;   // of the facet itself, as a share of the diagonal
  double limb = 0.04;   // of vertices and edges alone: length of its branch, likewise
};

// A level as a mesh of polygons, edges that stand by themselves, and single vertices.
struct Level {
  Column<Vec3> vertices;          // (v) in order of first use
  Column<double> radius;          // (v) of the empty ball
  Column<int32_t> vertex_of;      // (v) of the hierarchy
  Column<int32_t> face_offsets;   // (f + 1)
  Column<int32_t> face_vertices;  // convex, counter-clockwise about p -> q, lowest id first
  Column<Edge> generators;        // (f) input rows p < q; the facets are in their order
  Column<int32_t> facet_of;       // (f) of the hierarchy
  Column<Edge> wires;             // (w) edges without a facet: vertices
  Column<int32_t> edge_of;        // (w) of the hierarchy
  Column<int32_t> points;         // (k) vertices without an edge
  Betti betti = {};               // counted on all this
  // Edges from a vertex to itself, and facets with fewer than three other edges: they count, but
  // cannot be drawn.
  int64_t hidden = 0;
};

// Its const members may be called from several threads.
class Hierarchy {
 public:
  struct Parts;
  // For the library itself; see MedialAnalysis::hierarchy.
  explicit Hierarchy(std::unique_ptr<const Parts> parts);
  ~Hierarchy();
  Hierarchy(Hierarchy&&) noexcept;
  Hierarchy& operator=(Hierarchy&&) noexcept;

  const Betti& betti() const;  // of the whole complex
  double diagonal() const;     // of the box of the samples
  // Throws InvalidInputError for thresholds below 0, Cancelled.
  Level extract(const LevelThresholds& thresholds, Progress* progress = nullptr) const;
  const Timings& timings() const;

  // What the collapse made, for the library itself.
  const Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<const Parts> parts_;
};

}  // namespace medial
