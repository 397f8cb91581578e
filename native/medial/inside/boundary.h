// SPDX-License-Identifier: GPL-3.0-or-later
// Finds how triangles use their edges, and where a triangle soup is not closed.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/csr.h"
#include "base/parallel.h"
#include "base/triangle.h"

namespace medial {

// A triangle has an edge from a vertex to a higher one: forward if it goes from the lower one.
struct EdgeUse {
  int32_t other, triangle;
  bool forward;

  friend bool operator<(const EdgeUse& a, const EdgeUse& b) {
    return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
  }
};

// Lists the uses of the edges from a vertex to higher ones, edge by edge.
inline void list_uses(std::span<const Triangle> triangles, std::span<const int32_t> fan, int32_t id,
                      std::vector<EdgeUse>& uses) {
  uses.clear();
  for (const int32_t t : fan) {
    const auto [next, previous] = link_of(triangles[t], id);
    if (next > id) uses.push_back({next, t, true});
    if (previous > id) uses.push_back({previous, t, false});
  }
  std::sort(uses.begin(), uses.end());
}

// Calls found(lower end, uses, out) for each edge, in lexicographic order; returns what it appends.
// `fans` lists the triangles at each vertex.
template <typename T, typename Found>
std::vector<T> append_by_edge(std::span<const Triangle> triangles, const Csr<int32_t>& fans,
                              const Run& run, const Found& found) {
  std::vector<std::vector<EdgeUse>> uses_of(run.threads);
  return parallel_append<T>(fans.size(), run, [&](int64_t p, std::vector<T>& out, int worker) {
    const auto id = static_cast<int32_t>(p);
    auto& uses = uses_of[worker];
    list_uses(triangles, fans[p], id, uses);
    for (size_t i = 0, end = 0; i < uses.size(); i = end) {
      while (end < uses.size() && uses[end].other == uses[i].other) ++end;
      found(id, std::span<const EdgeUse>(uses).subspan(i, end - i), out);
    }
  });
}

// Returns the boundary of the triangles: the directed edges that they use more often than their
// opposites, once per surplus use. If it is empty, the triangles are closed, and the winding number
// is an integer off the surface. `fans` lists the triangles at each vertex.
std::vector<Edge> boundary_edges(std::span<const Triangle> triangles, const Csr<int32_t>& fans,
                                 const Run& run);

}  // namespace medial
