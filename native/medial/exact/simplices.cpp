// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/simplices.h"

#include <algorithm>

#include "base/sort.h"

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
};

std::vector<Diagonal> edges_and_diagonals(const Level& level) {
  std::vector<Diagonal> all;
  all.reserve(2 * level.face_vertices.size() + level.wires.size());
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
  return all;
}

// Returns whether each polygon shares one of its diagonals.
std::vector<uint8_t> polygons_that_share(const Level& level, const Run& run) {
  std::vector<uint8_t> shares(level.face_offsets.size() - 1, 0);
  const auto all = edges_and_diagonals(level);
  const auto end_of = [&](int end) { return [&all, end](int64_t i) { return all[i].ends[end]; }; };
  const auto order = bucket_order(static_cast<int64_t>(all.size()), level.vertices.size(), run,
                                  end_of(0), end_of(1));
  for (size_t i = 1; i < order.size(); ++i) {
    const Diagonal &one = all[order[i - 1]], &other = all[order[i]];
    if (one.ends != other.ends) continue;
    for (const int32_t polygon : {one.polygon, other.polygon}) {
      if (polygon >= 0) shares[polygon] = 1;
    }
  }
  return shares;
}

}  // namespace

Simplices simplices_of(const Level& level, const Run& run) {
  Simplices made;
  const auto shares = polygons_that_share(level, run);
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
