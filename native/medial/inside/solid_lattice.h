// SPDX-License-Identifier: GPL-3.0-or-later
// The places of a cubic lattice that lie in a solid, a bit for each: volumes as numbers of places.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/run.h"
#include "inside/winding_number.h"

namespace medial {

class SolidLattice {
 public:
  // `box` holds the solid, which is where the winding number exceeds 1/2. The step is such that
  // about `places` of them lie in the solid, unless it fills so little of its box that the lattice
  // would have more than `most` places.
  SolidLattice(const WindingNumber& winding, const Box& box, int64_t places, int64_t most,
               const Run& run);

  int64_t count() const { return count_; }  // of places in the solid when it was made
  double step() const { return step_; }

  // The number of places that are left in a closed ball.
  int64_t count(const Vec3& centre, double radius) const;
  void remove(const Vec3& centre, double radius);
  // All that are left, row after row.
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
  int64_t words_ = 0;           // of a row, which runs along x
  std::vector<uint64_t> bits_;  // row after row, those along y first
};

}  // namespace medial
