// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/simplices.h"

#include <algorithm>

namespace medial {
namespace {

using Ring = std::span<const int32_t>;

Ring corners_of(const Level& level, int64_t polygon) {
  const auto begin = static_cast<size_t>(level.face_offsets[polygon]);
  return {level.face_vertices.data() + begin,
          static_cast<size_t>(level.face_offsets[polygon + 1]) - begin};
}

Edge ordered(int32_t a, int32_t b) { return {std::min(a, b), std::max(a, b)}; }

// An edge, and the polygon that it is a diagonal of; -1 for edges of polygons and wires.
struct Diagonal {
  Edge ends;
  int32_t polygon;
  auto operator<=>(const Diagonal&) const = default;
};

std::vector<Diagonal> edges_and_diagonals(const Level& level) {
  std::vector<Diagonal> all;
  for (size_t f = 0; f + 1 < level.face_offsets.size(); ++f) {
    const Ring c = corners_of(level, static_cast<int64_t>(f));
    for (size_t i = 0; i < c.size(); ++i) {
      all.push_back({ordered(c[i], c[(i + 1) % c.size()]), -1});
    }
    for (size_t i = 2; i + 1 < c.size(); ++i) {
      all.push_back({ordered(c[0], c[i]), static_cast<int32_t>(f)});
    }
  }
  for (const auto& [a, b] : level.wires) all.push_back({ordered(a, b), -1});
  std::sort(all.begin(), all.end());
  return all;
}

// Returns whether each polygon shares one of its diagonals.
std::vector<uint8_t> polygons_that_share(const Level& level) {
  std::vector<uint8_t> shares(level.face_offsets.size() - 1, 0);
  const auto all = edges_and_diagonals(level);
  for (size_t i = 1; i < all.size(); ++i) {
    if (all[i].ends != all[i - 1].ends) continue;
    for (const int32_t polygon : {all[i].polygon, all[i - 1].polygon}) {
      if (polygon >= 0) shares[polygon] = 1;
    }
  }
  return shares;
}

}  // namespace

Simplices simplices_of(const Level& level) {
  Simplices made;
  const auto shares = polygons_that_share(level);
  auto centre = static_cast<int32_t>(level.vertices.size());
  for (int32_t f = 0; f < static_cast<int32_t>(shares.size()); ++f) {
    const Ring c = corners_of(level, f);
    const auto add = [&](const Triangle& t) {
      made.triangles.push_back(t);
      made.source.push_back(f);
    };
    if (shares[f]) {
      for (size_t i = 0; i < c.size(); ++i) add({c[i], c[(i + 1) % c.size()], centre});
      made.centres.push_back(f);
      ++centre;
    } else {
      for (size_t i = 1; i + 1 < c.size(); ++i) add({c[0], c[i], c[i + 1]});
    }
  }
  return made;
}

}  // namespace medial
