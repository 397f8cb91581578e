// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy of the inner medial axis is one ordered collapse of the inner Voronoi complex. It
// yields every level of simplification, including the curve skeleton, each with the topology of the
// solid.
#pragma once

#include <medial/progress.h>
#include <medial/types.h>

#include <memory>

namespace medial {

using Betti = std::array<int64_t, 3>;  // components, tunnels, cavities

// How a vertex of a level was placed.
enum class Placing : uint8_t {
  voronoi,   // at a Voronoi vertex, or of a wire, or where no faces are known
  refused,   // the ball of the walls is not empty, or too far away; the Voronoi vertex stays
  touching,  // the ball touches the walls, and no face is nearer
  rim,       // at the end of a smooth sheet; in results of earlier versions only
  crease,    // on a convex crease, with radius 0
  corner     // at the end of convex creases, with radius 0
};

// These options choose which cells stay, and how they are shown. A cell stays if it exceeds the
// first four thresholds, or the fifth one; cells that the collapse left always stay. Infinity
// removes every cell that can be removed.
struct LevelOptions {
  double sheet = 0;          // least thickness of its sheet, as a share of the diagonal
  double spacings = 0;       // the same in local spacings of the samples
  double erosion = 0;        // the same of the facet itself, as a share of the diagonal
  double spike = 0;          // least thickness of a disc of its sheet round it, likewise
  double limb = 0.04;        // least length of its branch, likewise; vertices and edges only
  bool round_limbs = false;  // keep wires with a loose end only in round limbs
  // Wires are smoothed, divided anew and fitted to the samples round them.
  bool relaxed = false;
  // Vertices of even meshes are where balls touch the faces, if the hierarchy has any, and so are
  // those of facets that are not relaxed, if it has crisp places. Curves end in the tips of cones.
  bool crisp = false;
};

// These options choose the level that gets an even mesh, as in LevelOptions. Its vertices are where
// balls touch the faces if `crisp`.
struct EvenOptions {
  double spacings = 0, limb = 0.04;
  bool round_limbs = false, crisp = false;
};

// A level is a mesh of polygons, edges without a facet, and single vertices.
struct Level {
  Column<Vec3> vertices;  // (v) in order of first use
  Column<double> radius;  // (v) radius of the ball, the empty one unless relaxed
  // Each vertex represents a vertex of the hierarchy, which is a Voronoi vertex inside the solid: a
  // new vertex of a wire the nearest one along it, so neighbours may represent the same one.
  Column<int32_t> vertex_of;      // (v) id in the hierarchy
  Column<Vec3> exact;             // (v) its place
  Column<double> exact_radius;    // (v) of the empty ball there
  Column<Placing> place;          // (v)
  Column<int32_t> face_offsets;   // (f + 1)
  Column<int32_t> face_vertices;  // convex, counter-clockwise about p -> q, lowest id first
  Column<Edge> generators;        // (f) input rows p < q; the facets are in their order
  Column<int32_t> facet_of;       // (f) id in the hierarchy
  Column<double> theta, rho;      // (f) as in MedialMesh, by the rule of the hierarchy
  Column<float> sheet, erosion;   // (f) values of the facet, infinite where it always stays
  Column<Edge> wires;             // (w) edges without a facet: vertices
  Column<int32_t> edge_of;        // (w) id in the hierarchy; for new ones that at the middle
  Column<float> limb;             // (w) value of the edge, infinite where it always stays
  Column<int32_t> points;         // (k) vertices without an edge
  Betti betti = {};               // counted on all this
  // This counts edges from a vertex to itself, facets with fewer than three other edges, and facets
  // with the corners of another one: they count for the topology, but cannot be drawn.
  int64_t hidden = 0;
};

// Its const members may be called from several threads.
class Hierarchy {
 public:
  struct Parts;
  // Only the library constructs one; see MedialAnalysis::hierarchy.
  explicit Hierarchy(std::shared_ptr<const Parts> parts);
  ~Hierarchy();
  Hierarchy(Hierarchy&&) noexcept;
  Hierarchy& operator=(Hierarchy&&) noexcept;

  const Betti& betti() const;  // of the whole complex
  double diagonal() const;     // of the box of the samples
  size_t bytes() const;        // memory that it holds
  // Throws InvalidInputError for thresholds below 0, Cancelled.
  Level extract(const LevelOptions& options, Progress* progress = nullptr) const;
  // Gives a level a mesh of its own, of even triangles in place of the facets of the Voronoi
  // diagram, and returns the hierarchy of this mesh. Its facets are the triangles, in the order of
  // the facets for which they stand, and its levels without thresholds are all of the mesh. Throws
  // InvalidInputError for thresholds below 0, and for a hierarchy that is one of an even mesh.
  Hierarchy even(const EvenOptions& options, Progress* progress = nullptr) const;
  // Returns the hierarchy of the same even mesh at other thresholds of MEDIAL, where these are
  // higher; what lower ones would select is not in the mesh. Throws InvalidInputError for
  // thresholds out of range, and for a hierarchy that is not one of an even mesh.
  Hierarchy selecting(double theta, double rho, Progress* progress = nullptr) const;
  const Timings& timings() const;

  // Returns the results of the collapse, for the library itself.
  const Parts& parts() const { return *parts_; }

 private:
  std::shared_ptr<const Parts> parts_;
};

}  // namespace medial
