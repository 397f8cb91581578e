// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles as ids of their corners.
#pragma once

#include <medial/types.h>

namespace medial {

// Next and previous corner of a triangle seen from corner `id`.
inline Edge link_of(const Triangle& t, int32_t id) {
  const int i = t[0] == id ? 0 : t[1] == id ? 1 : 2;
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

}  // namespace medial
