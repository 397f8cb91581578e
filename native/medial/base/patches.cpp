// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/patches.h"

#include "base/union_find.h"

namespace medial {

std::vector<int32_t> patches(std::span<const Triangle> triangles, std::span<const uint8_t> wanted,
                             size_t vertices) {
  UnionFind corners(vertices);
  for (size_t t = 0; t < triangles.size(); ++t) {
    if (!wanted[t]) continue;
    const auto& [a, b, c] = triangles[t];
    corners.unite(a, b);
    corners.unite(b, c);
  }
  const auto first = std::move(corners).representatives();
  std::vector<int32_t> number(vertices, -1), result(triangles.size(), -1);
  int32_t count = 0;
  for (size_t t = 0; t < triangles.size(); ++t) {
    if (!wanted[t]) continue;
    int32_t& patch = number[first[triangles[t][0]]];
    if (patch < 0) patch = count++;
    result[t] = patch;
  }
  return result;
}

}  // namespace medial
