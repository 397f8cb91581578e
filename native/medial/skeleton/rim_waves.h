// SPDX-License-Identifier: GPL-3.0-or-later
// Takes short waves out of rims, without drawing them in.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"

namespace medial {

// Holds the vertices of rims that move, and their neighbours along the rims.
class RimWaves {
 public:
  // `beside` has the neighbours of each vertex of `moving`, two at least; those that do not move
  // are fixed. `vertices` is more than any of them. Waves of up to about 2.5 times the square root
  // of `rounds` edges are taken out, and less where a rim is shorter than a few of these waves.
  RimWaves(std::vector<int32_t> moving, std::vector<std::span<const int32_t>> beside,
           size_t vertices, int rounds);

  // Returns how far each vertex has to move from its place; `places` has all vertices.
  std::vector<Vec3> moves(std::span<const Vec3> places) const;

 private:
  void limit_rounds(int most);
  int rounds_of(size_t first, std::vector<uint8_t>& seen, std::vector<size_t>& rim) const;
  template <typename Fixed>
  std::vector<Vec3> means(std::span<const Vec3> of, const Fixed& fixed) const;

  std::vector<int32_t> moving_;
  std::vector<std::span<const int32_t>> beside_;
  std::vector<int32_t> row_;  // per vertex: its place in moving_, or -1 if it is fixed
  std::vector<int> rounds_;   // per moving vertex
};

}  // namespace medial
