// Triangles and edges as ids of their corners.
#pragma once

#include <array>
#include <cstdint>

namespace medial {

using Triangle = std::array<int32_t, 3>;
using Edge = std::array<int32_t, 2>;

// Next and previous corner of a triangle seen from corner `id`.
inline Edge link_of(const Triangle& t, int32_t id) {
  const int i = t[0] == id ? 0 : t[1] == id ? 1 : 2;
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

}  // namespace medial
