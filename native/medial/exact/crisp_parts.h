// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the stage that makes crisp places, and the state that they share.
#pragma once

#include "base/csr.h"
#include "exact/crisp.h"
#include "exact/empty_ball.h"

namespace medial {

// A vertex, and two samples that a facet without area separates there.
using Hidden = std::array<int32_t, 3>;

// Holds the facets that get crisp places, and what is known of the places of their vertices so far.
// Its const members may be called from several threads.
class CrispState {
 public:
  CrispState(const InnerComplex& of, const Triangulation& cells, const SamplesOnFaces& on_faces,
             std::span<const Thickness> values, std::span<const double> sines,
             std::span<const uint8_t> selected, const Run& whole);

  // Returns the largest hole between the samples of the facets at a vertex.
  double spacing_at(int32_t v) const;
  void take(int32_t v, const Touch& found);

  // Calls found(facet, corner) for all corners of the facets.
  template <typename Found>
  void for_corners(const Found& found) const {
    for (const int32_t f : facets) {
      for (const Corner& c : complex.ring(f)) found(f, c);
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
  std::vector<Hidden> hidden;   // ascending
  CrispPlaces made;
  Array<Walls> walls;  // per vertex: what its ball touches

 private:
  void find_facets(std::span<const Thickness> values);
  void find_rims();
  void find_hidden(std::span<const uint8_t> selected);
};

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

 private:
  // Returns whether a facet has an edge without another facet at a vertex.
  bool ends_at(int32_t facet, int32_t v) const;
  void onto_corner(int32_t v, double within);

  CrispState& c_;
  PointTree corners_;
  std::vector<Vec3> corner_points_;
};

}  // namespace medial
