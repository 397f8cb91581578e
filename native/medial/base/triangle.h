// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle is the ids of its corners.
#pragma once

#include <medial/types.h>

namespace medial {

// Returns the next and the previous corner of a triangle, seen from corner `id`.
inline Edge link_of(const Triangle& t, int32_t id) {
  const int i = t[0] == id ? 0 : t[1] == id ? 1 : 2;
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

}  // namespace medial
