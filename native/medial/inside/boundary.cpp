// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/boundary.h"

namespace medial {

std::vector<Edge> boundary_edges(std::span<const Triangle> triangles, const Csr<int32_t>& fans,
                                 const Run& run) {
  return append_by_edge<Edge>(
      triangles, fans, run, [](int32_t id, std::span<const EdgeUse> uses, std::vector<Edge>& out) {
        const int32_t other = uses[0].other;
        int32_t surplus = 0;
        for (const EdgeUse& use : uses) surplus += use.forward ? 1 : -1;
        for (; surplus > 0; --surplus) out.push_back({id, other});
        for (; surplus < 0; ++surplus) out.push_back({other, id});
      });
}

}  // namespace medial
