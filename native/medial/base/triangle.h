// SPDX-License-Identifier: GPL-3.0-or-later
// A triangle is the ids of its corners.
#pragma once

#include <medial/types.h>

#include <algorithm>

namespace medial {

inline Triangle ascending(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

// Whether no corner is named twice.
inline bool has_three_corners(const Triangle& t) {
  return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

inline bool has_corner(const Triangle& t, int32_t id) {
  return std::find(t.begin(), t.end(), id) != t.end();
}

// Returns which corner of a triangle `id` is.
inline int corner_of(const Triangle& t, int32_t id) { return t[0] == id ? 0 : t[1] == id ? 1 : 2; }

// Returns the next and the previous corner of a triangle, seen from corner `id`.
inline Edge link_of(const Triangle& t, int32_t id) {
  const int i = corner_of(t, id);
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

}  // namespace medial
