// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the stage that makes crisp places, and the state that they share.
#pragma once

#include "base/csr.h"
#include "skeleton/crisp.h"
#include "skeleton/smooth_rim.h"

namespace medial {

// A vertex, and two samples that a facet without area separates there.
using Hidden = std::array<int32_t, 3>;

// Holds the facets that get crisp places, and what is known of the places of their vertices so far.
// Its const members may be called from several threads.
class CrispState {
 public:
  // `edges` tells which edges of the complex belong to the level of least thickness.
  CrispState(const InnerComplex& of, const Triangulation& cells, const SamplesOnFaces& on_faces,
             std::span<const Thickness> values, std::span<const double> sines,
             std::span<const uint8_t> selected, std::span<const uint8_t> edges, const Run& whole);

  // Returns the largest hole between the samples of the facets at a vertex.
  double spacing_at(int32_t v) const;
  void take(int32_t v, const Touch& found);
  // Moves a vertex to a place at the end of a sheet, if there are samples near the faces there.
  void end_at(int32_t v, const Vec3& place);
  // Returns whether a vertex is on a rim that ends in no crease and at no seam.
  bool is_open_rim(int32_t v) const;

  // Calls found(facet, corner) for all corners of the facets.
  template <typename Found>
  void for_corners(const Found& found) const {
    for (const int32_t f : facets) {
      for (const Corner& c : complex.ring(f)) found(f, c);
    }
  }
  // Calls found(corner, other) for the edges of each facet at a vertex, where `corner` names the
  // edge and `other` is its other end.
  template <typename Found>
  void for_edges(int32_t v, const Found& found) const {
    for (const int32_t f : facets_at[v]) {
      const auto ring = complex.ring(f);
      for (size_t i = 0; i < ring.size(); ++i) {
        const size_t next = (i + 1) % ring.size();
        if (ring[i].vertex == v) found(ring[i], ring[next].vertex);
        if (ring[next].vertex == v) found(ring[i], ring[i].vertex);
      }
    }
  }

  const InnerComplex& complex;
  const Triangulation& triangulation;
  const SamplesOnFaces& samples;
  std::span<const double> sine;  // per facet
  Run run;
  Progress* progress;
  std::vector<int32_t> facets;  // those that get places
  Csr<int32_t> facets_at;       // per vertex: the facets at it
  Array<uint8_t> edge_uses;     // per edge: the facets at it; 3 means three or more
  Array<uint8_t> on_rim;        // per vertex
  Array<uint8_t> on_seam;       // per vertex
  Csr<int32_t> beside;          // per vertex: its neighbours along rims, ascending
  std::vector<Edge> wires;      // a vertex of facets, and the other end of an edge without facets
  std::vector<Hidden> hidden;   // ascending
  CrispPlaces made;
  Array<Walls> walls;           // per vertex: what its ball touches
  Array<SmoothRim> smooth_rim;  // per vertex
  Array<int32_t> follows;       // per vertex: the vertex in whose place it is, or -1
  std::vector<int32_t> followers;
  Array<uint8_t> stays;  // per vertex: whether it is the end of a wire

 private:
  void find_facets(std::span<const Thickness> values);
  void find_rims();
  void find_wires(std::span<const uint8_t> edges);
  void find_hidden(std::span<const uint8_t> selected);
};

// --- crisp_dense.cpp

// Returns for each vertex whether it stays at its Voronoi vertex, as the samples round it are on
// curved walls, and so dense that no one would see it move.
Array<uint8_t> dense_vertices(const CrispState& state);

// --- crisp_walls.cpp

// Returns the walls of a vertex: its samples are of one wall where no facet separates them. On a
// curved wall all samples mostly have one foot, so the first one will do unless `thorough`.
Walls walls_at(const CrispState& state, int32_t v, bool thorough);
// Finds the ball that touches some walls near a place. A wall that it sticks out of is added, up to
// a number of walls.
Touch touch(const CrispState& state, int32_t v, const Walls& walls, const Vec3& start,
            size_t most = kMostContacts);

// --- crisp_creases.cpp: rims that end in creases

class CreaseRims {
 public:
  explicit CreaseRims(CrispState& state);

  // Moves a vertex of a rim onto its crease, with radius 0; returns whether there is one. It may be
  // called from several threads.
  bool onto_crease(int32_t v);
  // Moves the nearest vertex on a crease to each corner that no vertex has reached.
  void reach_corners();
  // Smooths the rims that end in zigzags of creases.
  void smooth_zigzags();

 private:
  // Returns whether a facet has an edge without another facet at a vertex.
  bool ends_at(int32_t facet, int32_t v) const;
  double reach_of(const PlaceOnCrease& place) const;
  void onto_corner(int32_t v, double within);
  std::vector<int32_t> on_zigzags();
  Vec3 end_between(const Edge& samples, int32_t v, const Vec3& on_crease) const;
  bool same_direction(const PlaceOnCrease& a, const PlaceOnCrease& b) const;
  Vec3 direction(int32_t edge) const;

  CrispState& c_;
  PointTree corners_;
  std::vector<Vec3> corner_points_;
};

// --- crisp_rims.cpp: rims of smooth sheets

// Moves the vertices of smooth rims to where the two places that a ball touches become one.
void settle_smooth_rims(CrispState& state);

// --- crisp_rim_order.cpp

// Vertices of a rim that went to the end of the sheet may have changed their order along it, as
// those of a fillet, which samples put near to a line, do. They move towards the middle of their
// neighbours along the rim until it no longer turns back, and then to the end of the sheet again.
void order_rims(CrispState& state);

// --- crisp_fillets.cpp

// Vertices of rims beyond the last ball that touches two places go back to that ball. It lies
// between them and a neighbour that has found its place, as at a fillet, all of whose balls have
// one centre.
void end_fillets(CrispState& state);
// Returns the nearest neighbour of a vertex whose ball touches two walls, or -1.
int32_t placed_neighbour(const CrispState& state, int32_t v);
// Returns the last ball that touches two places on the way between two places, which are seen under
// a certain openness at least.
Touch last_ball(const CrispState& state, int32_t v, const Walls& walls, const Vec3& inner,
                const Vec3& beyond, double openness_at_least);

// --- crisp_wires.cpp

// A wire that ends at facets, as the axis of a cylinder does, ends where the ball touches walls all
// round it and one before it. Such places stay when facets are unfolded.
void end_wires(CrispState& state);
// Returns the points in which smooth faces end, as in the tip of a cone.
std::vector<Vec3> tips_of(const Faces& faces);

// --- crisp_focal.cpp

// Draws what is near the rim of a fillet, whose balls all have one centre line, together on that
// line.
void gather_focal_rims(CrispState& state);

// --- crisp_seams.cpp

// A vertex may reach a seam without being on one: the sheet of the samples goes on a little where
// that of the faces ends. It follows the nearest neighbour that is on the seam, or else the order
// along the seam would be lost.
void join_seams(CrispState& state);
// Moves the vertices that follow others to their places.
void follow(CrispState& state);

// --- crisp_folds.cpp

// Facets fold where places that nearly coincide changed their order. Their vertices take steps
// towards the middle of their neighbours, along the seam or crease that they are on.
void unfold(CrispState& state);
// Returns whether a facet is turned over, or its boundary runs back or crosses itself, as seen
// along the line between its samples; if `dented`, also whether it has a deep dent. A facet at the
// rim of a hole has a slight one.
bool is_folded(const CrispState& state, int32_t facet, bool dented);
// Returns whether the corners of a facet are not all on one line, as seen in the same way.
bool has_area(const CrispState& state, int32_t facet);

// --- crisp_contraction.cpp

// Facets that no step unfolds have corners that nearly coincide. One of these goes to the place of
// another, along an edge, where fewer facets are folded then.
void contract_folds(CrispState& state);

}  // namespace medial
