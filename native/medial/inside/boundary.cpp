// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/boundary.h"

#include "base/parallel.h"

namespace medial {

std::vector<Edge> boundary_edges(std::span<const Triangle> triangles, const Csr<int32_t>& fans,
                                 const Run& run) {
  std::vector<std::vector<Edge>> uses_of(run.threads);
  return parallel_append<Edge>(fans.size(), run,
                               [&](int64_t p, std::vector<Edge>& out, int worker) {
                                 const auto id = static_cast<int32_t>(p);
                                 // Holds (other end, direction) of the edges whose lower end is
                                 // `id`.
                                 auto& uses = uses_of[worker];
                                 uses.clear();
                                 for (const int32_t t : fans[p]) {
                                   const auto [next, previous] = link_of(triangles[t], id);
                                   if (next > id) uses.push_back({next, 1});
                                   if (previous > id) uses.push_back({previous, -1});
                                 }
                                 std::sort(uses.begin(), uses.end());
                                 for (size_t i = 0; i < uses.size();) {
                                   const int32_t other = uses[i][0];
                                   int32_t surplus = 0;
                                   for (; i < uses.size() && uses[i][0] == other; ++i)
                                     surplus += uses[i][1];
                                   for (; surplus > 0; --surplus) out.push_back({id, other});
                                   for (; surplus < 0; ++surplus) out.push_back({other, id});
                                 }
                               });
}

}  // namespace medial
