// SPDX-License-Identifier: GPL-3.0-or-later
// Stores which places of a cubic lattice are in a solid, a bit for each, to measure volumes as
// numbers of places.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/run.h"
#include "inside/winding_number.h"

namespace medial {

class SolidLattice {
 public:
  // Fills the lattice; `box` contains the solid, which is where the winding number exceeds 1/2. The
  // step is chosen such that about `places` places are in the solid, unless the solid fills so
  // little of its box that the lattice would have more than `most` places.
  SolidLattice(const WindingNumber& winding, const Box& box, int64_t places, int64_t most,
               const Run& run);

  int64_t count() const { return count_; }  // the initial number of places in the solid
  double step() const { return step_; }

  // Returns the number of places that are left in a closed ball.
  int64_t count(const Vec3& centre, double radius) const;
  void remove(const Vec3& centre, double radius);
  // Brings back the places of the ball that `whole` has, a copy from before places were removed.
  void restore(const SolidLattice& whole, const Vec3& centre, double radius);
  // Returns all places that are left, row after row.
  std::vector<Vec3> places() const;

 private:
  void fill(const WindingNumber& winding, const Box& box, double step, const Run& run);
  void fill_row(const WindingNumber& winding, int64_t row, std::vector<int>& closed);
  Vec3 place(int64_t row, int64_t i) const;
  int64_t whole_count() const;
  template <typename Visit>
  void visit_words(const Vec3& centre, double radius, const Visit& visit) const;

  Vec3 origin_;
  double step_ = 0;
  int64_t count_ = 0;
  std::array<int64_t, 3> size_ = {};
  int64_t words_ = 0;           // words per row; a row runs along x
  std::vector<uint64_t> bits_;  // row after row, first along y, then along z
};

}  // namespace medial
