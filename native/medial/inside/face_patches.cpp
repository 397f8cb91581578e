// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/face_patches.h"

#include <algorithm>

#include "base/csr.h"
#include "base/rows.h"
#include "base/union_find.h"

namespace medial {
namespace {

// Two faces that share an edge; or one of another number of faces at an edge, and -1.
struct Meeting {
  int32_t first, second;
  bool same_side;  // they use the edge in opposite directions
};

struct Use {
  int32_t other, face;
  bool forward;

  bool operator<(const Use& use) const {
    return other != use.other ? other < use.other : face < use.face;
  }
};

// Lists the uses of the edges from a vertex to higher ones, edge by edge.
void find_uses(std::span<const Triangle> faces, std::span<const int32_t> fan, int32_t vertex,
               std::vector<Use>& uses) {
  uses.clear();
  for (const int32_t face : fan) {
    const auto [next, previous] = link_of(faces[face], vertex);
    if (next > vertex) uses.push_back({next, face, true});
    if (previous > vertex) uses.push_back({previous, face, false});
  }
  std::sort(uses.begin(), uses.end());
}

std::vector<Meeting> meetings(std::span<const Triangle> faces, int32_t vertices, const Run& run) {
  const auto fans = rows_containing(faces, vertices, run);
  std::vector<std::vector<Use>> uses_of(run.threads);
  return parallel_append<Meeting>(
      vertices, run, [&](int64_t v, std::vector<Meeting>& out, int worker) {
        auto& uses = uses_of[worker];
        find_uses(faces, fans[v], static_cast<int32_t>(v), uses);
        for (size_t i = 0, end = 0; i < uses.size(); i = end) {
          while (end < uses.size() && uses[end].other == uses[i].other) ++end;
          const bool two = end - i == 2 && uses[i].face != uses[i + 1].face;
          if (two) {
            out.push_back({uses[i].face, uses[i + 1].face, uses[i].forward != uses[i + 1].forward});
          } else {
            for (size_t k = i; k < end; ++k) out.push_back({uses[k].face, -1, false});
          }
        }
      });
}

bool repeats_a_corner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

// Leaves out faces that have the same corners as another one, in any order.
void leave_out_repeated(std::vector<Triangle>& faces, Repeated repeated) {
  std::vector<Triangle> sorted(faces);
  for (Triangle& t : sorted) std::sort(t.begin(), t.end());
  std::vector<int32_t> order = all_rows(faces.size());
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return sorted[a] != sorted[b] ? sorted[a] < sorted[b] : a < b;
  });
  for (size_t i = 0, end = 0; i < order.size(); i = end) {
    while (end < order.size() && sorted[order[end]] == sorted[order[i]]) ++end;
    const bool none = repeated == Repeated::first_of_odd && (end - i) % 2 == 0;
    for (size_t k = none ? i : i + 1; k < end; ++k) faces[order[k]].fill(sorted[order[k]][0]);
  }
}

void number_patches(FacePatches& patches, OrientedUnionFind sets) {
  const size_t count = patches.faces.size();
  std::vector<int32_t> number(count, -1);
  patches.patch.assign(count, -1);
  patches.turned.assign(count, 0);
  for (size_t face = 0; face < count; ++face) {
    if (repeats_a_corner(patches.faces[face])) continue;
    const auto [root, turned] = sets.find(static_cast<int32_t>(face));
    if (number[root] < 0) number[root] = patches.count++;
    patches.patch[face] = number[root];
    patches.turned[face] = turned ? 1 : 0;
  }
}

}  // namespace

FacePatches face_patches(std::span<const Triangle> triangles,
                         std::span<const int32_t> vertex_of_row, int32_t vertices,
                         Repeated repeated, const Run& run) {
  FacePatches patches;
  patches.faces.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    const Triangle t{vertex_of_row[i], vertex_of_row[j], vertex_of_row[k]};
    patches.faces.push_back(repeats_a_corner(t) ? Triangle{t[0], t[0], t[0]} : t);
  }
  if (repeated != Repeated::all) leave_out_repeated(patches.faces, repeated);
  std::vector<Triangle> counted(patches.faces);
  for (Triangle& t : counted) {
    if (repeats_a_corner(t)) t.fill(-1);
  }
  const auto edges = meetings(counted, vertices, run);
  OrientedUnionFind sets(counted.size());
  patches.closed = !edges.empty();
  for (const auto& [first, second, same_side] : edges) {
    patches.closed = patches.closed && same_side;
    if (second >= 0) sets.unite(first, second, !same_side);
  }
  number_patches(patches, std::move(sets));
  patches.open.assign(static_cast<size_t>(patches.count), 0);
  for (const auto& [first, second, same_side] : edges) {
    if (second < 0) patches.open[patches.patch[first]] = 1;
  }
  return patches;
}

}  // namespace medial
