// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/solid_betti.h"

#include "base/union_find.h"

namespace medial {
namespace {

// Returns whether the triangles at a vertex are one fan: their links form one closed path.
bool is_fan(std::span<const Triangle> triangles, std::span<const int32_t> at, int32_t vertex) {
  const int32_t first = link_of(triangles[at[0]], vertex)[0];
  int32_t here = first;
  for (size_t steps = 1; steps <= at.size(); ++steps) {
    int32_t next = -1;
    for (const int32_t t : at) {
      const Edge link = link_of(triangles[t], vertex);
      if (link[0] != here) continue;
      if (next >= 0) return false;  // this edge has more than two triangles
      next = link[1];
    }
    if (next < 0) return false;
    here = next;
    if (here == first) return steps == at.size();
  }
  return false;
}

}  // namespace

std::optional<std::array<int64_t, 3>> solid_betti(const Surface& surface,
                                                  std::span<const Vec3> points, const Run& run) {
  if (!surface.closed()) return std::nullopt;
  const std::span<const Triangle> triangles(surface.triangles);
  const auto vertices = static_cast<int32_t>(points.size());
  const auto fans = rows_containing(triangles, vertices, run);
  int64_t used = 0;
  for (int32_t v = 0; v < vertices; ++v) {
    if (fans[v].empty()) continue;
    if (!is_fan(triangles, fans[v], v)) return std::nullopt;
    ++used;
  }
  UnionFind shells(points.size(), run);
  for (const auto& [a, b, c] : triangles) {
    shells.unite(a, b);
    shells.unite(a, c);
  }
  const Array<int32_t> shell = std::move(shells).representatives();
  std::vector<double> volume(points.size());  // six times the volume of each shell
  for (const auto& [a, b, c] : triangles) {
    const Vec3& o = points[shell[a]];
    volume[shell[a]] += dot(points[a] - o, cross(points[b] - o, points[c] - o));
  }
  std::array<int64_t, 3> betti = {};
  for (int32_t v = 0; v < vertices; ++v) {
    if (fans[v].empty() || shell[v] != v) continue;
    if (volume[v] == 0) return std::nullopt;
    ++betti[volume[v] > 0 ? 0 : 2];
  }
  const int64_t euler = used - static_cast<int64_t>(triangles.size()) / 2;
  betti[1] = betti[0] + betti[2] - euler / 2;
  return betti;
}

}  // namespace medial
