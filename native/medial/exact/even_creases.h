// SPDX-License-Identifier: GPL-3.0-or-later
// Rims of sheets that lead into sharp convex edges of the solid end on them, with radius 0.
#pragma once

#include "remesh/remesh.h"
#include "walls/samples_on_faces.h"

namespace medial {

// The rims of an even mesh that end in sharp convex edges of the solid.
class EvenCreases {
 public:
  // `generators` are per facet, and `hole` and `radius` per vertex at the start. The arguments must
  // outlive this object.
  EvenCreases(EvenMesh& even, const SamplesOnFaces& samples, std::span<const Edge> generators,
              std::span<const double> hole, std::span<const double> radius, const Run& run);

  // Moves vertices of rims onto creases, where the mesh holds them from then on, and to the corners
  // of these, which become nodes. Those that would turn a triangle over stay for the next call.
  void hold();
  // Fills the notches of rims that leave a crease and come back to it beside.
  void fill_notches();

 private:
  struct OnCrease;
  struct Move {
    int32_t vertex;
    Vec3 place;    // before
    uint8_t held;  // before
  };
  double hole_at(int32_t v) const { return hole_[e_.origin[v]]; }
  OnCrease crease_of(int32_t v) const;
  void put(int32_t v, const Vec3& place, uint8_t held);
  std::vector<int32_t> put_on_lines();
  void reach_corners();
  void reach_corners_from(std::span<const int32_t> vertices);
  void mend();
  int32_t held_beside(int32_t v) const;
  bool join_line(int32_t v);
  bool take_in_passed(int32_t v);
  std::vector<int32_t> ends_beside(int32_t v) const;
  bool are_beside_on_line(int32_t a, int32_t b) const;
  void fill_notch(int32_t v, int32_t a);

  EvenMesh& e_;
  const SamplesOnFaces& samples_;
  std::span<const Edge> generators_;
  std::span<const double> hole_, radius_;
  Run run_;
  std::vector<Vec3> corners_;
  PointTree tree_;                // of the corners
  std::vector<Move> moves_;       // since the last call began
  std::vector<int32_t> changed_;  // triangles of a collapse
};

// `samples` must outlive what is returned.
OntoLine onto_creases(const SamplesOnFaces* samples);
// Makes one vertex of those that are held at one place, where the mesh keeps its topology by it.
void unite_held(EvenMesh& even);

}  // namespace medial
