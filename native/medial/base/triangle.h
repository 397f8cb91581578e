// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle is the ids of its corners.
#pragma once

#include <medial/types.h>

namespace medial {

// Returns which corner of a triangle `id` is.
inline int corner_of(const Triangle& t, int32_t id) { return t[0] == id ? 0 : t[1] == id ? 1 : 2; }

// Returns the next and the previous corner of a triangle, seen from corner `id`.
inline Edge link_of(const Triangle& t, int32_t id) {
  const int i = corner_of(t, id);
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

}  // namespace medial
